#include "devices/sim/hand/hand_actor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "devices/sim/hand/grip.hpp"

namespace armsreach::sim {
namespace {

// A posture counts as a gesture within this share of the way to or from it.
constexpr double kArrived = 0.1;

// From 0 to 1 with no velocity and no acceleration at either end.
double eased(double s) { return s * s * s * (10 + s * (6 * s - 15)); }

HandPose key_pose(const HandKey& key, const HandAnatomy& anatomy) {
  HandPose pose = key.grip > 0 ? pose_around(anatomy, key.grip) : pose_of(key.gesture, anatomy);
  pose[wrist_flexion] = key.wrist_flexion;
  pose[wrist_deviation] = key.wrist_deviation;
  return within_limits(pose);
}

}  // namespace

HandActor::HandActor(const HandDescription& description)
    : description_(description), anatomy_(random_anatomy(description.seed)) {
  for (const HandKey& key : description_.keys) poses_.push_back(key_pose(key, anatomy_));
}

HandActor::Stretch HandActor::stretch(double time) const {
  const std::vector<HandKey>& keys = description_.keys;
  const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                      [](double t, const HandKey& key) { return t < key.time; });
  if (after == keys.begin()) return {0, 0, 0};
  const std::size_t to = static_cast<std::size_t>(after - keys.begin());
  if (after == keys.end()) return {to - 1, to - 1, 0};
  const double length = keys[to].time - keys[to - 1].time;
  return {to - 1, to, eased((time - keys[to - 1].time) / length)};
}

HandPose HandActor::pose(double time) const {
  const Stretch s = stretch(time);
  return blend(poses_[s.from], poses_[s.to], s.fraction);
}

Pose HandActor::frame_from_hand(std::size_t index) const {
  const HandKey& key = description_.keys[index];
  const auto about = [](int axis, double angle) {
    return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis));
  };
  Eigen::Quaterniond turn(about(2, key.turn.z()) * about(1, key.turn.y()) * about(0, key.turn.x()));
  if (description_.frame == HandFrame::camera) turn = turn * about(0, std::numbers::pi);
  const Eigen::Vector3d palm(0, 0.75 * anatomy_.fingers[1].knuckle.y(), 0);
  return {turn, key.at - turn * palm};
}

Pose HandActor::world_from_hand(double time, const Pose& world_from_camera) const {
  const Stretch s = stretch(time);
  const Pose a = frame_from_hand(s.from);
  const Pose b = frame_from_hand(s.to);
  // The palm's middle goes straight; it turns the short way.
  const Eigen::Vector3d palm(0, 0.75 * anatomy_.fingers[1].knuckle.y(), 0);
  const Eigen::Quaterniond turn = a.rotation().slerp(s.fraction, b.rotation());
  const Eigen::Vector3d at = (1 - s.fraction) * (a * palm) + s.fraction * (b * palm);
  const Pose frame_from_hand(turn, at - turn * palm);
  return description_.frame == HandFrame::camera ? world_from_camera * frame_from_hand
                                                 : frame_from_hand;
}

HandTruth HandActor::truth(double time, const Pose& world_from_camera) const {
  const Stretch s = stretch(time);
  const HandKey& from = description_.keys[s.from];
  const HandKey& to = description_.keys[s.to];
  HandTruth truth;
  truth.left = description_.left;
  truth.pose = pose(time);
  truth.holds = from.hold;
  if (from.gesture == to.gesture || s.fraction < kArrived) truth.gesture = from.gesture;
  if (s.fraction > 1 - kArrived) truth.gesture = to.gesture;
  const Pose world_from_right = world_from_hand(time, world_from_camera);
  const HandSkeleton skeleton = skeleton_of(anatomy_, truth.pose);
  for (std::size_t i = 0; i < kHandJointCount; ++i) {
    const Pose& joint = skeleton.hand_from_joint[i];
    truth.world_from_joint[i] = world_from_right * (truth.left ? mirrored(joint) : joint);
  }
  return truth;
}

}  // namespace armsreach::sim
