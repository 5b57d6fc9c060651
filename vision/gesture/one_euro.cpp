#include "vision/gesture/one_euro.hpp"

#include <numbers>

namespace armsreach::gesture {
namespace {

// Weight of the new sample in a first-order low pass.
double smoothing(double cutoff, double seconds) {
  const double turn = 2 * std::numbers::pi * cutoff * seconds;
  return turn / (turn + 1);
}

}  // namespace

Eigen::Vector2d OneEuro::filter(const Eigen::Vector2d& point, double unit, Timestamp time) {
  if (!options_.enabled) return point;
  if (!last_) {
    last_ = {time, point, point, Eigen::Vector2d::Zero()};
    return point;
  }
  const double seconds = seconds_from_timestamp(time - last_->time);
  if (seconds <= 0) return last_->filtered;
  const Eigen::Vector2d moved = (point - last_->raw) / (unit * seconds);
  const Eigen::Vector2d speed =
      last_->speed + smoothing(options_.speed_cutoff, seconds) * (moved - last_->speed);
  const double cutoff = options_.min_cutoff + options_.beta * speed.norm();
  const Eigen::Vector2d filtered =
      last_->filtered + smoothing(cutoff, seconds) * (point - last_->filtered);
  last_ = {time, point, filtered, speed};
  return filtered;
}

}  // namespace armsreach::gesture
