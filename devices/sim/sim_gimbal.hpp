// A simulated gimbal: moves as its model says (vision/core/gimbal_motion.hpp), on the clock of its
// sensor, and is the same for the same commands.
#pragma once

#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "devices/command_log.hpp"
#include "devices/gimbal.hpp"
#include "vision/core/gimbal_motion.hpp"

namespace armsreach::sim {

class SimGimbal final : public Gimbal {
 public:
  // The script is followed until somebody else commands.
  SimGimbal(std::string name, const GimbalModel& model, std::vector<GimbalCommand> script);

  const std::string& name() const override { return name_; }
  Status rest() override;
  const GimbalModel& model() const override { return motion_.model(); }
  Status command(const GimbalCommand& command) override;
  std::optional<GimbalState> state_at(Timestamp time) const override;
  std::vector<GimbalCommand> take_commands() override;

  // Lets the time pass up to `time`, which never goes back, and measures the axes there.
  GimbalState advance(Timestamp time);

 private:
  void obey(const GimbalCommand& command);

  std::string name_;
  mutable std::mutex mutex_;
  GimbalMotion motion_;
  std::deque<GimbalCommand> script_;  // not yet given
  CommandLog log_;
  std::deque<GimbalState> measured_;
};

}  // namespace armsreach::sim
