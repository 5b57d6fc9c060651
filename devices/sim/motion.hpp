// Where the things of a world are at a time.
#pragma once

#include <vector>

#include "devices/sim/world.hpp"

namespace armsreach::sim {

Pose pose_at(const Thing& thing, double time);

// Of all things, in their order.
std::vector<Pose> poses_at(const World& world, double time);

}  // namespace armsreach::sim
