#include "devices/sim/path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "devices/sim/random.hpp"

namespace armsreach::sim {
namespace {

// Bands of a hand-held camera: sway of arms and body, physiological tremor of the hand.
struct Band {
  double low;   // Hz
  double high;  // Hz
  int sines;
};
constexpr Band kSway{0.3, 1.6, 5};
constexpr Band kShake{7, 11, 4};

Spline spline_through(const PathDescription& path) {
  std::vector<double> times;
  std::vector<Spline::Point> points;
  for (const PathKey& key : path.keys) {
    times.push_back(key.time);
    Spline::Point point;
    point << key.eye, key.target, key.roll;
    points.push_back(point);
  }
  if (times.size() == 1) {  // a tripod
    times.push_back(times[0] + path.duration);
    points.push_back(points[0]);
  }
  return {std::move(times), std::move(points), path.closed && path.keys.size() > 1, path.duration};
}

}  // namespace

Spline::Spline(std::vector<double> times, std::vector<Point> points, bool closed, double period)
    : times_(std::move(times)), points_(std::move(points)), closed_(closed), period_(period) {
  if (closed_) {
    times_.push_back(times_.front() + period_);
    points_.push_back(points_.front());
  }
  // Equal velocity on both sides of every inner knot gives one equation each for the accelerations
  // m: h0 m0 + 2 (h0 + h1) m1 + h1 m2 = 6 ((p2 - p1) / h1 - (p1 - p0) / h0).
  const Eigen::Index n = static_cast<Eigen::Index>(times_.size());
  const auto time = [this](Eigen::Index i) { return times_[static_cast<std::size_t>(i)]; };
  const auto point = [this](Eigen::Index i) { return points_[static_cast<std::size_t>(i)]; };
  Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 7);
  const auto join = [&](Eigen::Index row, Eigen::Index before, Eigen::Index at,
                        Eigen::Index after) {
    const double h0 = time(before + 1) - time(before);
    const double h1 = time(after) - time(after - 1);
    equations(row, before) += h0;
    equations(row, at) += 2 * (h0 + h1);
    equations(row, after) += h1;
    right.row(row) =
        6 * ((point(after) - point(at)) / h1 - (point(at) - point(before)) / h0).transpose();
  };
  for (Eigen::Index i = 1; i + 1 < n; ++i) join(i, i - 1, i, i + 1);
  if (closed_) {
    join(0, n - 2, 0, 1);
    equations(n - 1, n - 1) = 1;  // the last knot is the first
    equations(n - 1, 0) = -1;
  } else {
    equations(0, 0) = 1;
    equations(n - 1, n - 1) = 1;
  }
  const Eigen::MatrixXd solved = equations.partialPivLu().solve(right);
  for (Eigen::Index i = 0; i < n; ++i) accelerations_.push_back(solved.row(i).transpose());
}

Spline::Point Spline::at(double time) const {
  double t = time - times_.front();
  t = closed_ ? t - period_ * std::floor(t / period_) : t;
  t = std::clamp(t + times_.front(), times_.front(), times_.back());
  const auto after = std::upper_bound(times_.begin() + 1, times_.end() - 1, t);
  const std::size_t i = static_cast<std::size_t>(after - times_.begin());
  const double h = times_[i] - times_[i - 1];
  const double b = (t - times_[i - 1]) / h;
  const double a = 1 - b;
  return a * points_[i - 1] + b * points_[i] +
         h * h / 6 *
             ((a * a * a - a) * accelerations_[i - 1] + (b * b * b - b) * accelerations_[i]);
}

Unrest::Unrest(const Tremor& tremor, double duration, std::uint64_t seed) {
  Random random(seed);
  const auto add = [&](std::vector<Sine>& axis, const Band& band, double rms) {
    for (int i = 0; i < band.sines; ++i) {
      const double rate = random.uniform(band.low, band.high);
      const double turns = std::max(1.0, std::round(rate * duration));
      axis.push_back({rms * std::sqrt(2.0 / band.sines), 2 * std::numbers::pi * turns / duration,
                      random.uniform(0, 2 * std::numbers::pi)});
    }
  };
  for (std::size_t axis = 0; axis < 6; ++axis) {
    add(axes_[axis], kSway, axis < 3 ? tremor.sway : tremor.sway_angle);
    add(axes_[axis], kShake, axis < 3 ? tremor.shake : tremor.shake_angle);
  }
}

Vector6d Unrest::at(double time) const {
  Vector6d sum = Vector6d::Zero();
  for (std::size_t axis = 0; axis < 6; ++axis) {
    for (const Sine& sine : axes_[axis])
      sum[static_cast<Eigen::Index>(axis)] +=
          sine.amplitude * std::sin(sine.angular_rate * time + sine.phase);
  }
  return sum;
}

Eigen::Quaterniond looking_along(const Eigen::Vector3d& forward) {
  const Eigen::Vector3d z = forward.normalized();
  const Eigen::Vector3d right = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rotation;
  rotation << right, z.cross(right), z;
  return Eigen::Quaterniond(rotation);
}

CameraPath::CameraPath(const PathDescription& description, std::uint64_t seed)
    : duration_(description.duration),
      closed_(description.closed),
      spline_(spline_through(description)),
      unrest_(description.tremor, description.duration, seed) {}

Pose CameraPath::world_from_camera(double time) const {
  const double along = closed_ ? time : std::clamp(time, 0.0, duration_);
  const Spline::Point point = spline_.at(along);
  const Eigen::Vector3d eye = point.head<3>();
  const Eigen::Quaterniond held =
      looking_along(point.segment<3>(3) - eye) * so3_exp(Eigen::Vector3d(0, 0, point[6]));
  return Pose(held, eye) * Pose::exp(unrest_.at(along));
}

}  // namespace armsreach::sim
