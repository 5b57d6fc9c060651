#include "devices/sim/sim_gimbal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace armsreach::sim {
namespace {

constexpr Timestamp kStep = 1'000'000;  // ns
constexpr double kSeconds = 1e-3;       // of a step
constexpr Timestamp kRemembered = 3'000'000'000;

}  // namespace

SimGimbal::SimGimbal(std::string name, const GimbalModel& model, std::vector<GimbalCommand> script)
    : name_(std::move(name)), model_(model), script_(script.begin(), script.end()) {}

Status SimGimbal::rest() {
  const std::lock_guard lock(mutex_);
  script_.clear();
  pending_.clear();
  goal_ = now_.angles;
  return ok();
}

Status SimGimbal::command(const GimbalCommand& command) {
  if (!command.angles.allFinite()) {
    return Error{"the gimbal's angles are not finite", name_, "command finite angles"};
  }
  const std::lock_guard lock(mutex_);
  script_.clear();
  log_.push_back({command.time, clamped(model_, command.angles)});
  const Timestamp begins = std::max(command.time, now_.time) + timestamp_from_seconds(model_.lag);
  // What was to happen later than this is overruled.
  while (!pending_.empty() && pending_.back().time >= begins) pending_.pop_back();
  pending_.push_back({begins, log_.back().angles});
  return ok();
}

std::optional<GimbalState> SimGimbal::state_at(Timestamp time) const {
  const std::lock_guard lock(mutex_);
  return interpolated_state(measured_, time);
}

std::vector<GimbalCommand> SimGimbal::take_commands() {
  const std::lock_guard lock(mutex_);
  return std::exchange(log_, {});
}

GimbalState SimGimbal::advance(Timestamp time) {
  const std::lock_guard lock(mutex_);
  while (now_.time + kStep <= time) step();
  GimbalState state = now_;
  state.time = time;
  state.angles += seconds_from_timestamp(time - now_.time) * now_.rates;
  state.angles = clamped(model_, state.angles);
  measured_.push_back(state);
  while (measured_.front().time + kRemembered < time) measured_.pop_front();
  return state;
}

void SimGimbal::take_due() {
  while (!script_.empty() && script_.front().time <= now_.time) {
    log_.push_back({script_.front().time, clamped(model_, script_.front().angles)});
    pending_.push_back({now_.time + timestamp_from_seconds(model_.lag), log_.back().angles});
    script_.pop_front();
  }
  while (!pending_.empty() && pending_.front().time <= now_.time) {
    goal_ = pending_.front().angles;
    pending_.pop_front();
  }
}

void SimGimbal::step() {
  take_due();
  for (int axis = 0; axis < 3; ++axis) {
    const double way = goal_[axis] - now_.angles[axis];
    const double braking = model_.acceleration[axis];
    // The fastest from which it can still stop at the goal, which in whole steps of dt is the v
    // with v dt / 2 + v^2 / (2 a) = way; and never past it within this one.
    const double half = 0.5 * braking * kSeconds;
    const double stoppable = std::sqrt(half * half + 2 * braking * std::abs(way)) - half;
    const double wanted =
        std::copysign(std::min({stoppable, model_.fastest[axis], std::abs(way) / kSeconds}), way);
    double& rate = now_.rates[axis];
    rate += std::clamp(wanted - rate, -braking * kSeconds, braking * kSeconds);
    now_.angles[axis] += rate * kSeconds;
  }
  const Eigen::Vector3d inside = clamped(model_, now_.angles);
  now_.rates = (inside.array() == now_.angles.array()).select(now_.rates, 0);
  now_.angles = inside;
  now_.time += kStep;
}

}  // namespace armsreach::sim
