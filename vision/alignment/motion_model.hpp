// Decaying constant velocity: where the camera probably is now, from where it was.
#pragma once

#include "vision/core/pose.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

struct MotionOptions {
  double velocity_kept = 0.9;  // fraction of the velocity that is left after `interval`
  double interval = 1.0 / 30;  // s
  // What a head or a hand can do to a camera between two frames beyond what was predicted.
  double greatest_speed = 3;  // m/s
  double greatest_turn = 6;   // rad/s
  double remembered = 0.3;    // s without a measurement after which a prediction says nothing
};

class MotionModel {
 public:
  explicit MotionModel(MotionOptions options) : options_(options) {}

  void start(const Pose& world_from_camera, Timestamp time);
  // A pose that was measured.
  void update(const Pose& world_from_camera, Timestamp time);
  // No measurement: the prediction becomes the pose and the velocity decays.
  void coast(Timestamp time);

  Pose predicted(Timestamp time) const;
  const Pose& measured() const { return measured_; }  // the last pose that was
  // Whether the last measurement still says something about where the camera is.
  bool recent(Timestamp time) const;
  bool plausible(const Pose& world_from_camera, Timestamp time) const;

 private:
  double seconds_since(Timestamp then, Timestamp time) const;

  MotionOptions options_;
  Pose world_from_camera_;  // at time_
  Pose measured_;
  Vector6d velocity_ = Vector6d::Zero();  // per second, on the right of world_from_camera_
  Timestamp time_ = 0;
  Timestamp measured_time_ = 0;
};

}  // namespace armsreach
