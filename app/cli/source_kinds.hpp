// Every kind of source this program has: real devices, recordings and their simulated twins.
#pragma once

#include <vector>

#include "devices/open.hpp"

namespace armsreach::app {

std::vector<SourceKind> all_source_kinds();

}  // namespace armsreach::app
