// Where the joints of a hand are: forward kinematics.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "devices/sim/hand/anatomy.hpp"
#include "devices/sim/hand/hand_pose.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

// The 25 joints of WebXR's hand input, in its order. A joint's frame stands at its near end and
// turns with the bone that begins there: y along the bone, z to the pad's side. Tips are points of
// the surface.
enum class HandJoint : std::size_t {
  wrist,
  thumb_metacarpal,
  thumb_proximal,
  thumb_distal,
  thumb_tip,
  index_metacarpal,
  index_proximal,
  index_intermediate,
  index_distal,
  index_tip,
  middle_metacarpal,
  middle_proximal,
  middle_intermediate,
  middle_distal,
  middle_tip,
  ring_metacarpal,
  ring_proximal,
  ring_intermediate,
  ring_distal,
  ring_tip,
  little_metacarpal,
  little_proximal,
  little_intermediate,
  little_distal,
  little_tip
};
inline constexpr std::size_t kHandJointCount = 25;
std::string_view name(HandJoint joint);

// Joints of a finger from its metacarpal (part 0) to its tip: 5, of the thumb 4.
HandJoint joint_of(Finger finger, int part);
HandJoint tip_of(Finger finger);

struct HandSkeleton {
  std::array<Pose, kHandJointCount> hand_from_joint;
  Pose hand_from_forearm;  // stands in the wrist, y towards the hand

  const Pose& operator[](HandJoint joint) const {
    return hand_from_joint[static_cast<std::size_t>(joint)];
  }
};

// Of a right hand.
HandSkeleton skeleton_of(const HandAnatomy& anatomy, const HandPose& pose);

// A pose in a right hand's frame as it is in its mirror image, a left hand's.
Pose mirrored(const Pose& hand_from_joint);

}  // namespace armsreach::sim
