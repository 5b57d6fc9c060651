// The start target as a sheet to print.
#pragma once

#include <string>

#include "vision/core/result.hpp"

namespace armsreach::app {

// A black rectangle of width x height [m] in the middle of an A4 page, with a scale to check the
// print by. PDF.
Status write_target_sheet(const std::string& file, double width, double height);

}  // namespace armsreach::app
