// Whatever carries a camera of a world: a hand along the path, a tripod, or the wearer.
#pragma once

#include <cstdint>
#include <functional>

#include "devices/sim/hand/hand_actor.hpp"
#include "devices/sim/world.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

// world_from_mount at a time [s].
using Carrier = std::function<Pose(double)>;

Carrier carrier_of(const World& world, const SensorDescription& sensor, std::uint64_t seed);
// Of the wearer with that seed, where the sensor is worn; else none.
Shoulders shoulders_of(const World& world, const SensorDescription& sensor, std::uint64_t seed);

}  // namespace armsreach::sim
