#include "vision/core/gimbal_motion.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach {
namespace {

constexpr Timestamp kStep = 1'000'000;  // ns
constexpr double kSeconds = 1e-3;       // of a step

}  // namespace

GimbalMotion::GimbalMotion(const GimbalModel& model, const GimbalState& start)
    : model_(model), now_(start), goal_(start.angles) {}

void GimbalMotion::command(const GimbalCommand& command) {
  const Timestamp begins = std::max(command.time, now_.time) + timestamp_from_seconds(model_.lag);
  while (!pending_.empty() && pending_.back().time >= begins) pending_.pop_back();
  pending_.push_back({begins, clamped(model_, command.angles)});
}

void GimbalMotion::halt() {
  pending_.clear();
  goal_ = now_.angles;
}

GimbalState GimbalMotion::advance(Timestamp time) {
  while (now_.time + kStep <= time) step();
  GimbalState state = now_;
  state.time = time;
  state.angles += seconds_from_timestamp(time - now_.time) * now_.rates;
  state.angles = clamped(model_, state.angles);
  return state;
}

void GimbalMotion::step() {
  while (!pending_.empty() && pending_.front().time <= now_.time) {
    goal_ = pending_.front().angles;
    pending_.pop_front();
  }
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

}  // namespace armsreach
