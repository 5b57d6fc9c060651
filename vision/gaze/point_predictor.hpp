// Where a moving point will be, from delayed measurements of it: a Kalman filter over position,
// velocity and an acceleration that dies away. Source: Singer, "Estimating optimal tracking filter
// performance for manned maneuvering targets", IEEE Trans. AES 6(4), 1970.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vision/core/time.hpp"

namespace armsreach {

// As seen from the origin, so in radians: metres at a point's first distance, divided by it.
struct PointNoise {
  double measurement = 0.005;  // rad, rms
  double acceleration = 6;     // rad/s^2, rms
  double correlation = 0.3;    // s in which an acceleration has died away to 37 %
};

class PointPredictor {
 public:
  explicit PointPredictor(const PointNoise& noise) : noise_(noise) {}

  // Measurements older than the last one are left out. A single one far from what was predicted
  // is ignored; when the next agrees with it the point has leapt, and is taken to stand there.
  void observe(Timestamp time, const Eigen::Vector3d& point);
  void forget();

  // Nothing before the first measurement. No further than `horizon` beyond the last one: then it
  // stays there.
  std::optional<Eigen::Vector3d> at(Timestamp time) const;
  static constexpr double kHorizon = 0.4;  // s

 private:
  struct Sample {
    Timestamp time;
    Eigen::Vector3d point;
  };
  void start(const Sample& sample);
  void advance(double seconds);

  PointNoise noise_;
  bool started_ = false;
  Timestamp time_ = 0;
  double range_ = 1;            // m
  Eigen::Matrix3d state_;       // rows: position, velocity, acceleration; a column a coordinate
  Eigen::Matrix3d covariance_;  // of a column; the three coordinates are alike
  std::optional<Sample> straggler_;  // that did not fit
};

}  // namespace armsreach
