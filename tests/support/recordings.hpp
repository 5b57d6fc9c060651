// Where the real recordings are, for tests that need them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace armsreach::test {

// $ARMSREACH_DATA/name, or nothing when the variable is unset or the folder is not there.
std::optional<std::filesystem::path> recording(const std::string& name);

}  // namespace armsreach::test

// Skips the test, saying so, when a recording is absent; else declares `path`.
#define ARMSREACH_RECORDING_OR_SKIP(path, name)                                       \
  const auto path##_found = ::armsreach::test::recording(name);                       \
  if (!path##_found) GTEST_SKIP() << "set ARMSREACH_DATA to a folder that has " name; \
  const auto path = *path##_found
