#include "devices/sim/sim_gimbal.hpp"

#include <utility>

namespace armsreach::sim {
namespace {

constexpr Timestamp kRemembered = 3'000'000'000;

}  // namespace

SimGimbal::SimGimbal(std::string name, const GimbalModel& model, std::vector<GimbalCommand> script)
    : name_(std::move(name)), motion_(model), script_(script.begin(), script.end()) {}

Status SimGimbal::rest() {
  const std::lock_guard lock(mutex_);
  script_.clear();
  motion_.halt();
  return ok();
}

Status SimGimbal::command(const GimbalCommand& command) {
  if (!command.angles.allFinite()) {
    return Error{"the gimbal's angles are not finite", name_, "command finite angles"};
  }
  const std::lock_guard lock(mutex_);
  script_.clear();
  obey(command);
  return ok();
}

std::optional<GimbalState> SimGimbal::state_at(Timestamp time) const {
  const std::lock_guard lock(mutex_);
  return interpolated_state(measured_, time);
}

std::vector<GimbalCommand> SimGimbal::take_commands() {
  const std::lock_guard lock(mutex_);
  return log_.take();
}

GimbalState SimGimbal::advance(Timestamp time) {
  const std::lock_guard lock(mutex_);
  for (; !script_.empty() && script_.front().time <= time; script_.pop_front()) {
    motion_.advance(script_.front().time);
    obey(script_.front());
  }
  measured_.push_back(motion_.advance(time));
  while (measured_.front().time + kRemembered < time) measured_.pop_front();
  return measured_.back();
}

void SimGimbal::obey(const GimbalCommand& command) {
  motion_.command(command);
  log_.add({command.time, clamped(model(), command.angles)});
}

}  // namespace armsreach::sim
