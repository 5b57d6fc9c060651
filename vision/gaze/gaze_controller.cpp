#include "vision/gaze/gaze_controller.hpp"

#include <cmath>
#include <utility>

namespace armsreach {
namespace {

using Eigen::Vector3d;

constexpr Timestamp kStatesRemembered = 2'000'000'000;
constexpr Timestamp kPosesRemembered = 500'000'000;
constexpr double kFarAway = 1000;  // m, where a point is a direction

template <class Items>
void forget_before(Items& items, Timestamp time) {
  while (!items.empty() && items.front().time < time) items.pop_front();
}

}  // namespace

GazeController::GazeController(const GimbalModel& model, const Camera& camera,
                               const GazeSettings& settings)
    : model_(model), camera_(camera), settings_(settings), predictor_(settings.followed) {
  solution_.angles = clamped(model_, Vector3d::Zero());
}

void GazeController::begin(GazeMode mode, const std::string& name) {
  mode_ = mode;
  name_ = name;
  announced_ = false;
}

void GazeController::follow(const std::string& name) {
  begin(GazeMode::follow, name);
  predictor_ = PointPredictor(settings_.followed);
}

void GazeController::saccade_to_world(const Vector3d& point, const std::string& name) {
  aim_at(GazeMode::saccade, point, name);
}

void GazeController::fixate_in_world(const Vector3d& point, const std::string& name) {
  aim_at(GazeMode::fixate, point, name);
}

void GazeController::stabilise() { aim_at(GazeMode::fixate, std::nullopt, ""); }

void GazeController::rest() { begin(GazeMode::rest, ""); }

void GazeController::aim_at(GazeMode mode, const std::optional<Vector3d>& point,
                            const std::string& name) {
  begin(mode, name);
  goal_ = point;
  predictor_ = PointPredictor(settings_.fixated);
  if (!goal_) return;
  for (const MountSeen& seen : mounts_)
    predictor_.observe(seen.time, seen.world_from_mount.inverse() * *goal_);
}

GimbalCommand GazeController::step(const GazeInput& input) {
  if (input.gimbal) {
    states_.push_back(*input.gimbal);
    forget_before(states_, input.gimbal->time - kStatesRemembered);
  }
  if (input.pose) see_pose(*input.pose);
  if (input.target) see_target(*input.target);

  const auto obeyed = input.now + timestamp_from_seconds(model_.lag + settings_.lead);
  if (mode_ == GazeMode::rest) {
    solution_ = {clamped(model_, Vector3d::Zero())};
  } else if (const auto point = predictor_.at(obeyed)) {
    solution_ = look_at(model_, *point, up_in_mount(), solution_.angles);
  }
  announce(input.now);
  if (mode_ == GazeMode::saccade) end_saccade();
  announce(input.now);
  return {input.now, solution_.angles};
}

void GazeController::see_target(const TargetSeen& seen) {
  if (mode_ != GazeMode::follow) return;
  const auto state = interpolated_state(states_, seen.time);
  if (!state) return;
  const double distance = seen.distance.value_or(settings_.distance);
  const Vector3d point_in_camera = distance * unproject(camera_, seen.pixel).normalized();
  predictor_.observe(seen.time, mount_from_camera(model_, state->angles) * point_in_camera);
}

void GazeController::see_pose(const CameraPoseSeen& seen) {
  const auto state = interpolated_state(states_, seen.time);
  if (!state || (!mounts_.empty() && seen.time <= mounts_.back().time)) return;
  const Pose world_from_mount =
      seen.world_from_camera * mount_from_camera(model_, state->angles).inverse();
  mounts_.push_back({seen.time, world_from_mount});
  forget_before(mounts_, seen.time - kPosesRemembered);
  if (mode_ != GazeMode::saccade && mode_ != GazeMode::fixate) return;
  if (!goal_) goal_ = seen.world_from_camera * (kFarAway * Vector3d::UnitZ());
  predictor_.observe(seen.time, world_from_mount.inverse() * *goal_);
}

Vector3d GazeController::up_in_mount() const {
  if (mounts_.empty()) return settings_.up_in_mount;
  return mounts_.back().world_from_mount.rotation().conjugate() * settings_.up_in_world;
}

// The axis is on the target, or as near as the limits allow.
void GazeController::end_saccade() {
  if (states_.empty()) return;
  const GimbalState& state = states_.back();
  const auto point = predictor_.at(state.time);
  if (!point) return;
  const Vector3d in_camera = mount_from_camera(model_, state.angles).inverse() * *point;
  const double off = std::atan2(in_camera.head<2>().norm(), in_camera.z());
  const double way_left = (state.angles - solution_.angles).norm();
  if (off < settings_.arrived || (!reachable() && way_left < settings_.arrived))
    begin(GazeMode::fixate, name_);
}

void GazeController::announce(Timestamp now) {
  if (std::exchange(announced_, true)) return;
  events_.push_back({now, GazeEvent{mode_, solution_.angles, name_}});
}

Events GazeController::take_events() { return std::exchange(events_, {}); }

}  // namespace armsreach
