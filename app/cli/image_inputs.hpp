// Images that a command line names: files, and folders of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vision/core/result.hpp"

namespace armsreach::app {

// A folder's images in the order of their names; files as they were given. At least one.
Result<std::vector<std::filesystem::path>> image_files(const std::vector<std::string>& inputs);

}  // namespace armsreach::app
