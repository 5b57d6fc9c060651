// The worlds that come with the program.
#pragma once

#include <string>
#include <vector>

#include "devices/sim/world.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

const std::vector<std::string>& world_names();  // "bench", "near", ...
Result<World> load_world(const std::string& name);

}  // namespace armsreach::sim
