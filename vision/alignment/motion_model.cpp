#include "vision/alignment/motion_model.hpp"

#include <cmath>

namespace armsreach {

void MotionModel::start(const Pose& world_from_camera, Timestamp time) {
  world_from_camera_ = measured_ = world_from_camera;
  time_ = measured_time_ = time;
  velocity_.setZero();
}

// Times that stand still or go back count as one nominal interval.
double MotionModel::seconds_since(Timestamp then, Timestamp time) const {
  return time > then ? seconds_from_timestamp(time - then) : options_.interval;
}

void MotionModel::update(const Pose& world_from_camera, Timestamp time) {
  velocity_ = (measured_.inverse() * world_from_camera).log() / seconds_since(measured_time_, time);
  world_from_camera_ = measured_ = world_from_camera;
  time_ = measured_time_ = time;
}

void MotionModel::coast(Timestamp time) {
  const double seconds = seconds_since(time_, time);
  world_from_camera_ = predicted(time);
  velocity_ *= std::pow(options_.velocity_kept, seconds / options_.interval);
  time_ = time;
}

Pose MotionModel::predicted(Timestamp time) const {
  const double seconds = seconds_since(time_, time);
  const double kept = std::pow(options_.velocity_kept, seconds / options_.interval);
  return world_from_camera_ * Pose::exp(kept * seconds * velocity_);
}

bool MotionModel::recent(Timestamp time) const {
  const bool at_the_last_frame = time_ == measured_time_;
  return at_the_last_frame || seconds_since(measured_time_, time) <= options_.remembered;
}

bool MotionModel::plausible(const Pose& world_from_camera, Timestamp time) const {
  const double seconds = seconds_since(measured_time_, time);
  const Pose surprise = predicted(time).inverse() * world_from_camera;
  return surprise.is_finite() &&
         surprise.translation().norm() <= options_.greatest_speed * seconds &&
         so3_log(surprise.rotation()).norm() <= options_.greatest_turn * seconds;
}

}  // namespace armsreach
