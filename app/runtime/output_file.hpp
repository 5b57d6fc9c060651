// A file that a run writes; the two ways it can fail say so in the same words everywhere.
#pragma once

#include <fstream>
#include <string>

#include "vision/core/result.hpp"

namespace armsreach::app {

class OutputFile {
 public:
  Status open(const std::string& path);  // "" opens nothing, and all else then does nothing
  bool is_open() const { return stream_.is_open(); }
  std::ostream& stream() { return stream_; }
  Status close();  // whether everything reached the disk

 private:
  std::string path_;
  std::ofstream stream_;
};

// Opens, writes and closes.
template <class Write>
Status write_file(const std::string& path, Write write) {
  OutputFile file;
  if (auto status = file.open(path); !status || !file.is_open()) return status;
  write(file.stream());
  return file.close();
}

}  // namespace armsreach::app
