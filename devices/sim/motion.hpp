// Where the things of a world are at a time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "devices/sim/world.hpp"

namespace armsreach::sim {

Pose pose_at(const Thing& thing, double time);

// The same by its name, which is there.
std::function<Pose(const std::string&, double)> poses_of(std::vector<Thing> things);

// Of all things, in their order.
std::vector<Pose> poses_at(const World& world, double time);

}  // namespace armsreach::sim
