// Questions about files that never throw: what cannot be looked at is not there.
#pragma once

#include <filesystem>
#include <system_error>

namespace armsreach {

inline bool file_exists(const std::filesystem::path& path) {
  std::error_code failure;
  return std::filesystem::exists(path, failure);
}

inline bool folder_exists(const std::filesystem::path& path) {
  std::error_code failure;
  return std::filesystem::is_directory(path, failure);
}

}  // namespace armsreach
