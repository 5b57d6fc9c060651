#include "devices/sim/hand/hand_actor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "devices/sim/hand/grip.hpp"

namespace armsreach::sim {
namespace {

// A posture counts as a gesture within this share of the way to or from it.
constexpr double kArrived = 0.1;

const Eigen::Vector3d kDown(0, 0, -1);  // in the world

// From 0 to 1 with no velocity and no acceleration at either end.
double eased(double s) { return s * s * s * (10 + s * (6 * s - 15)); }

// About the frame's x, then y, then z.
Eigen::Quaterniond turned(const Eigen::Vector3d& angles) {
  const auto about = [&](int axis) {
    return Eigen::AngleAxisd(angles[axis], Eigen::Vector3d::Unit(axis));
  };
  return about(2) * about(1) * about(0);
}

HandPose key_pose(const HandKey& key, const HandAnatomy& anatomy) {
  HandPose pose = key.grip > 0 ? pose_around(anatomy, key.grip) : pose_of(key.gesture, anatomy);
  pose[wrist_flexion] = key.wrist_flexion;
  pose[wrist_deviation] = key.wrist_deviation;
  return within_limits(pose);
}

}  // namespace

HandActor::HandActor(const HandDescription& description, HandSurroundings surroundings)
    : description_(description),
      surroundings_(std::move(surroundings)),
      anatomy_(random_anatomy(description.seed)) {
  for (const HandKey& key : description_.keys) poses_.push_back(key_pose(key, anatomy_));
}

HandActor::Stretch HandActor::stretch(double time) const {
  const std::vector<HandKey>& keys = description_.keys;
  if (description_.repeat > 0) time -= description_.repeat * std::floor(time / description_.repeat);
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

Pose HandActor::frame_from_hand(const HandKey& key) const {
  Eigen::Quaterniond turn = turned(key.turn);
  if (description_.frame == HandFrame::camera)
    turn = turn * Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX());
  return {turn, key.at - turn * palm()};
}

Pose HandActor::thing_from_hand(const HandKey& key) const {
  const Eigen::Quaterniond turn = turned(key.turn);
  if (key.grip == 0) return {turn, key.at - turn * palm()};
  const Pose handle = hand_from_handle(anatomy_, key.grip);
  return Pose(turn, key.at) * (description_.left ? mirrored(handle) : handle).inverse();
}

Pose HandActor::world_from_key(const HandKey& key, double time,
                               const Pose& world_from_camera) const {
  if (!key.on.empty()) return surroundings_.world_from_thing(key.on, time) * thing_from_hand(key);
  if (description_.frame == HandFrame::camera) return world_from_camera * frame_from_hand(key);
  return frame_from_hand(key);
}

Eigen::Vector3d HandActor::palm() const { return {0, 0.75 * anatomy_.fingers[1].knuckle.y(), 0}; }

Pose HandActor::world_from_hand(double time, const Pose& world_from_camera) const {
  const Stretch s = stretch(time);
  const Pose a = world_from_key(description_.keys[s.from], time, world_from_camera);
  const Pose b = world_from_key(description_.keys[s.to], time, world_from_camera);
  // The palm's middle goes straight; it turns the short way.
  const Eigen::Quaterniond turn = a.rotation().slerp(s.fraction, b.rotation());
  const Eigen::Vector3d at = (1 - s.fraction) * (a * palm()) + s.fraction * (b * palm());
  return {turn, at - turn * palm()};
}

std::optional<Eigen::Vector3d> HandActor::world_shoulder(double time,
                                                         const Pose& world_from_camera) const {
  if (description_.shoulder) {
    if (description_.frame == HandFrame::world) return description_.shoulder;
    return world_from_camera * *description_.shoulder;
  }
  if (surroundings_.shoulders) return surroundings_.shoulders(description_.left, time);
  return std::nullopt;
}

HandMoment HandActor::at(double time, const Pose& world_from_camera) const {
  HandMoment moment{world_from_hand(time, world_from_camera), pose(time), std::nullopt};
  const auto shoulder = world_shoulder(time, world_from_camera);
  if (!shoulder) return moment;
  const Pose hand_from_world = moment.world_from_hand.inverse();
  Eigen::Vector3d in_hand = hand_from_world * *shoulder;
  // Before a camera whose place in the world is not known, down is the picture's.
  const bool in_picture = description_.shoulder && description_.frame == HandFrame::camera;
  Eigen::Vector3d down =
      hand_from_world.rotation() *
      (in_picture ? world_from_camera.rotation() * Eigen::Vector3d::UnitY() : kDown);
  if (description_.left) {
    in_hand.x() = -in_hand.x();
    down.x() = -down.x();
  }
  moment.arm = arm_to_shoulder(anatomy_, moment.pose, in_hand, down);
  moment.pose[wrist_flexion] = moment.arm->wrist_flexion;
  moment.pose[wrist_deviation] = moment.arm->wrist_deviation;
  return moment;
}

HandTruth HandActor::truth(double time, const Pose& world_from_camera) const {
  const Stretch s = stretch(time);
  const HandKey& from = description_.keys[s.from];
  const HandKey& to = description_.keys[s.to];
  HandTruth truth;
  truth.left = description_.left;
  const HandMoment moment = at(time, world_from_camera);
  truth.pose = moment.pose;
  truth.holds = from.hold;
  if (from.gesture == to.gesture || s.fraction < kArrived) truth.gesture = from.gesture;
  if (s.fraction > 1 - kArrived) truth.gesture = to.gesture;
  const HandSkeleton skeleton = skeleton_of(anatomy_, truth.pose);
  for (std::size_t i = 0; i < kHandJointCount; ++i) {
    const Pose& joint = skeleton.hand_from_joint[i];
    truth.world_from_joint[i] = moment.world_from_hand * (truth.left ? mirrored(joint) : joint);
  }
  return truth;
}

}  // namespace armsreach::sim
