// Runs the program as a user would: a command line in, an exit code, text and files out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace armsreach::test {

struct ProgramResult {
  int exit_code = -1;
  std::string output;  // stdout and stderr
};

ProgramResult run_armsreach(const std::vector<std::string>& arguments);

// A fresh folder of the running test, removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace armsreach::test
