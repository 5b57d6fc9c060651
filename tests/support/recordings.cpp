#include "tests/support/recordings.hpp"

#include <cstdlib>

namespace armsreach::test {

std::optional<std::filesystem::path> recording(const std::string& name) {
  const char* root = std::getenv("ARMSREACH_DATA");
  if (!root) return std::nullopt;
  const std::filesystem::path path = std::filesystem::path(root) / name;
  if (!std::filesystem::exists(path)) return std::nullopt;
  return path;
}

}  // namespace armsreach::test
