// Bringing points of the skin together: inverse kinematics.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/hand/anatomy.hpp"
#include "devices/sim/hand/hand_pose.hpp"
#include "devices/sim/hand/skeleton.hpp"

namespace armsreach::sim {

// A place on a finger's skin: on which bone (1 the one after the metacarpal, up to the last), at
// which share of its length, towards which side (in the bone's frame, about unit length).
struct SkinPlace {
  Finger finger = Finger::thumb;
  int part = 1;
  double along = 0.5;
  Eigen::Vector3d side{0, 0, 1};
};
struct SkinPoint {
  Eigen::Vector3d position;  // in the hand frame
  Eigen::Vector3d outwards;  // unit
};
SkinPoint skin_point(const HandAnatomy& anatomy, const HandSkeleton& skeleton,
                     const SkinPlace& place);

struct Contact {
  SkinPlace a;
  SkinPlace b;
};

// The posture nearest to `prior` in which all places touch, face to face. Only the angles of the
// fingers that touch move, within their limits.
HandPose touching(const HandAnatomy& anatomy, const HandPose& prior,
                  std::span<const Contact> contacts);

}  // namespace armsreach::sim
