// From a right hand's frame to where a hand, right or left, is.
#pragma once

#include "devices/sim/hand/hand_surface.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

// In place. A left hand is mirrored in its own x before; its triangles then go the other way round.
void place(const Pose& world_from_hand, bool left, PosedSurface& surface);

}  // namespace armsreach::sim
