// How a gimbal moves on its commands: three servos, each accelerating towards its angle as hard as
// it may and braking in time. The simulated gimbal is this; for servos that do not measure their
// angles it is the best that is known of them.
#pragma once

#include <deque>

#include "vision/core/gimbal.hpp"

namespace armsreach {

class GimbalMotion {
 public:
  explicit GimbalMotion(const GimbalModel& model, const GimbalState& start = {});

  const GimbalModel& model() const { return model_; }

  // Obeyed after the lag from the command's time on, or from where the motion has advanced to when
  // that is past; what was to happen later than that is overruled. Cut to the limits.
  void command(const GimbalCommand& command);
  // Stays wherever it is, as far as braking allows.
  void halt();

  // Lets the time pass, which never goes back; the state at that time.
  GimbalState advance(Timestamp time);

 private:
  void step();

  GimbalModel model_;
  GimbalState now_;  // at the last whole step
  Eigen::Vector3d goal_;
  std::deque<GimbalCommand> pending_;  // `time` is when the axes begin to obey
};

}  // namespace armsreach
