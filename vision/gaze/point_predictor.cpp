#include "vision/gaze/point_predictor.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kGate = 3;            // standard deviations
constexpr double kUnknownSpeed = 0.5;  // rad/s rms of a point just seen

// Singer's transition for acceleration' = -acceleration / correlation.
Matrix3d transition(double t, double correlation) {
  const double left = std::exp(-t / correlation);
  const double gained = correlation * (1 - left);
  Matrix3d f = Matrix3d::Identity();
  f(0, 1) = t;
  f(0, 2) = correlation * (t - gained);
  f(1, 2) = gained;
  f(2, 2) = left;
  return f;
}

// What the acceleration's white drive adds in a time that is short against its correlation.
Matrix3d added(double t, const PointNoise& noise) {
  const double density = 2 * noise.acceleration * noise.acceleration / noise.correlation;
  Matrix3d q;
  q << t * t * t * t * t / 20, t * t * t * t / 8, t * t * t / 6,  //
      t * t * t * t / 8, t * t * t / 3, t * t / 2,                //
      t * t * t / 6, t * t / 2, t;
  return density * q;
}

}  // namespace

void PointPredictor::forget() {
  started_ = false;
  straggler_.reset();
}

void PointPredictor::start(const Sample& sample) {
  started_ = true;
  straggler_.reset();
  time_ = sample.time;
  range_ = std::max(sample.point.norm(), 1e-3);
  state_.setZero();
  state_.row(0) = sample.point.transpose();
  covariance_ = range_ * range_ *
                Vector3d(noise_.measurement * noise_.measurement, kUnknownSpeed * kUnknownSpeed,
                         noise_.acceleration * noise_.acceleration)
                    .asDiagonal()
                    .toDenseMatrix();
}

void PointPredictor::advance(double seconds) {
  const Matrix3d f = transition(seconds, noise_.correlation);
  state_ = f * state_;
  covariance_ = f * covariance_ * f.transpose() + range_ * range_ * added(seconds, noise_);
}

void PointPredictor::observe(Timestamp time, const Vector3d& point) {
  if (!started_) return start({time, point});
  if (time <= time_) return;
  advance(seconds_from_timestamp(time - time_));
  time_ = time;
  const double measured = range_ * noise_.measurement;
  const Vector3d innovation = point - state_.row(0).transpose();
  const double variance = covariance_(0, 0) + measured * measured;
  if (innovation.squaredNorm() > kGate * kGate * variance) {
    const double apart = straggler_ ? (point - straggler_->point).norm() : innovation.norm();
    if (straggler_ && apart < innovation.norm() / 2) return start({time, point});
    straggler_ = Sample{time, point};
    return;
  }
  straggler_.reset();
  const Vector3d gain = covariance_.col(0) / variance;
  state_ += gain * innovation.transpose();
  covariance_ -= gain * gain.transpose() * variance;
  covariance_ = 0.5 * (covariance_ + covariance_.transpose().eval());
}

std::optional<Vector3d> PointPredictor::at(Timestamp time) const {
  if (!started_) return std::nullopt;
  const double ahead = std::clamp(seconds_from_timestamp(time - time_), 0.0, kHorizon);
  return Vector3d((transition(ahead, noise_.correlation) * state_).row(0).transpose());
}

}  // namespace armsreach
