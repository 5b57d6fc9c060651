#include "devices/sim/hand/skeleton.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace armsreach::sim {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::array<std::string_view, kHandJointCount> kNames{"wrist",
                                                               "thumb-metacarpal",
                                                               "thumb-phalanx-proximal",
                                                               "thumb-phalanx-distal",
                                                               "thumb-tip",
                                                               "index-finger-metacarpal",
                                                               "index-finger-phalanx-proximal",
                                                               "index-finger-phalanx-intermediate",
                                                               "index-finger-phalanx-distal",
                                                               "index-finger-tip",
                                                               "middle-finger-metacarpal",
                                                               "middle-finger-phalanx-proximal",
                                                               "middle-finger-phalanx-intermediate",
                                                               "middle-finger-phalanx-distal",
                                                               "middle-finger-tip",
                                                               "ring-finger-metacarpal",
                                                               "ring-finger-phalanx-proximal",
                                                               "ring-finger-phalanx-intermediate",
                                                               "ring-finger-phalanx-distal",
                                                               "ring-finger-tip",
                                                               "pinky-finger-metacarpal",
                                                               "pinky-finger-phalanx-proximal",
                                                               "pinky-finger-phalanx-intermediate",
                                                               "pinky-finger-phalanx-distal",
                                                               "pinky-finger-tip"};

Quaterniond about(int axis, double angle) {
  return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::Unit(axis)));
}
Pose bent(double flexion) { return {about(0, flexion), Vector3d::Zero()}; }
Pose along(double length) { return {Quaterniond::Identity(), {0, length, 0}}; }

Quaterniond thumb_turn(const HandPose& pose) {
  const double radial = pose[thumb_radial];
  const double palmar = pose[thumb_palmar];
  const Vector3d bone(std::sin(radial) * std::cos(palmar), std::cos(radial) * std::cos(palmar),
                      std::sin(palmar));
  const Vector3d to_index(-std::cos(radial), std::sin(radial), 0);
  const Vector3d pad =
      std::cos(pose[thumb_twist]) * to_index + std::sin(pose[thumb_twist]) * bone.cross(to_index);
  Eigen::Matrix3d turn;
  turn << bone.cross(pad), bone, pad;
  return Quaterniond(turn);
}

// The share of the palm's cupping that reaches a finger's metacarpal.
double cupping(Finger finger) {
  return finger == Finger::little ? 1.0 : finger == Finger::ring ? 0.5 : 0.0;
}

}  // namespace

std::string_view name(HandJoint joint) { return kNames[static_cast<std::size_t>(joint)]; }

HandJoint joint_of(Finger finger, int part) {
  const std::size_t first = finger == Finger::thumb ? 1 : 5 * static_cast<std::size_t>(finger);
  return static_cast<HandJoint>(first + static_cast<std::size_t>(part));
}
HandJoint tip_of(Finger finger) { return joint_of(finger, finger == Finger::thumb ? 3 : 4); }

HandSkeleton skeleton_of(const HandAnatomy& anatomy, const HandPose& pose) {
  HandSkeleton skeleton;
  const auto set = [&skeleton](HandJoint joint, const Pose& hand_from_joint) {
    skeleton.hand_from_joint[static_cast<std::size_t>(joint)] = hand_from_joint;
    return hand_from_joint;
  };
  const ThumbAnatomy& thumb = anatomy.thumb;
  Pose bone = set(HandJoint::thumb_metacarpal, {thumb_turn(pose), thumb.base});
  bone = set(HandJoint::thumb_proximal, bone * along(thumb.lengths[0]) * bent(pose[thumb_mcp]));
  bone = set(HandJoint::thumb_distal, bone * along(thumb.lengths[1]) * bent(pose[thumb_ip]));
  set(HandJoint::thumb_tip, bone * along(thumb.lengths[2]));
  for (const Finger finger : kFingers) {
    const FingerAnatomy& one = anatomy.fingers[static_cast<std::size_t>(finger) - 1];
    const auto angle = [&](FingerAngle which) { return pose[angle_index(finger, which)]; };
    const Pose lift{about(0, cupping(finger) * pose[cup]), one.base};
    const Vector3d metacarpal = one.knuckle - one.base;
    const Quaterniond lean = about(2, std::atan2(-metacarpal.x(), metacarpal.y()));
    set(joint_of(finger, 0), lift * Pose(lean, Vector3d::Zero()));
    const Pose spread{about(2, -angle(FingerAngle::spread)), metacarpal};
    bone = set(joint_of(finger, 1), lift * spread * bent(angle(FingerAngle::mcp)));
    bone = set(joint_of(finger, 2), bone * along(one.lengths[0]) * bent(angle(FingerAngle::pip)));
    bone = set(joint_of(finger, 3), bone * along(one.lengths[1]) * bent(angle(FingerAngle::dip)));
    set(joint_of(finger, 4), bone * along(one.lengths[2]));
  }
  const Quaterniond hand_turn = about(0, pose[wrist_flexion]) * about(2, -pose[wrist_deviation]);
  skeleton.hand_from_forearm = Pose(hand_turn.conjugate(), Vector3d::Zero());
  return skeleton;
}

Pose mirrored(const Pose& hand_from_joint) {
  const Quaterniond& q = hand_from_joint.rotation();
  const Vector3d& t = hand_from_joint.translation();
  // Mirroring in x keeps turns about x and reverses those about y and z.
  return {Quaterniond(q.w(), q.x(), -q.y(), -q.z()), {-t.x(), t.y(), t.z()}};
}

}  // namespace armsreach::sim
