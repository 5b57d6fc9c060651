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

// Whether a path in a list stays below the folder that the list lies in.
inline bool stays_inside(const std::filesystem::path& listed) {
  const std::filesystem::path path = listed.lexically_normal();
  return path.empty() || (path.is_relative() && *path.begin() != "..");
}

}  // namespace armsreach
