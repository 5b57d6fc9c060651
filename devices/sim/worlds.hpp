// The worlds that come with the program, and those of users in files of their own.
#pragma once

#include <string>
#include <vector>

#include "devices/sim/world.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

const std::vector<std::string>& world_names();  // "bench", "near", ...
bool is_world_file(const std::string& name);    // rather than the name of one of those
Result<World> load_world(const std::string& name);

}  // namespace armsreach::sim
