// A simulated gimbal: three servos, each accelerating towards its angle as hard as it may and
// braking in time. It runs on the clock of its sensor and is the same for the same commands.
#pragma once

#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "devices/gimbal.hpp"
#include "devices/sim/world.hpp"

namespace armsreach::sim {

class SimGimbal final : public Gimbal {
 public:
  // The script is followed until somebody else commands.
  SimGimbal(std::string name, const GimbalModel& model, std::vector<GimbalCommand> script);

  const std::string& name() const override { return name_; }
  Status rest() override;
  const GimbalModel& model() const override { return model_; }
  Status command(const GimbalCommand& command) override;
  std::optional<GimbalState> state_at(Timestamp time) const override;
  std::vector<GimbalCommand> take_commands() override;

  // Lets the time pass up to `time`, which never goes back, and measures the axes there.
  GimbalState advance(Timestamp time);

 private:
  void step();
  void take_due();

  std::string name_;
  GimbalModel model_;
  mutable std::mutex mutex_;
  std::deque<GimbalCommand> script_;   // not yet given
  std::deque<GimbalCommand> pending_;  // given; `time` is when the axes begin to obey
  std::vector<GimbalCommand> log_;
  GimbalState now_;  // at the last whole step
  Eigen::Vector3d goal_ = Eigen::Vector3d::Zero();
  std::deque<GimbalState> measured_;
};

}  // namespace armsreach::sim
