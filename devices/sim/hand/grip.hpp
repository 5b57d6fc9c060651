// A hand closed around a handle, a bottle or a pen.
#pragma once

#include "devices/sim/hand/anatomy.hpp"
#include "devices/sim/hand/hand_pose.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

// Joint by joint, each finger closes until its bone's flesh touches a round handle of this diameter
// [m] that lies across the palm; the thumb closes over it from the other side.
HandPose pose_around(const HandAnatomy& anatomy, double diameter);

// Where such a handle lies: x along its axis, towards the thumb; the origin before the middle
// finger.
Pose hand_from_handle(const HandAnatomy& anatomy, double diameter);

}  // namespace armsreach::sim
