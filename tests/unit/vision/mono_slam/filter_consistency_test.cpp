// Whether the filter is as wrong as it says: the normalised estimation error squared (Bar-Shalom).
#include <numeric>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/cameras.hpp"
#include "vision/mono_slam/filter.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPixelSigma = 0.5;
constexpr int kFrames = 150;

// The camera really moves as the filter believes, by constant velocity and white impulses, before
// points whose depth was measured once.
class Walk {
 public:
  explicit Walk(unsigned seed) : random_(seed), filter_(test::wide_angle(), 40, kPixelSigma) {
    filter_.start(truth_, 1e-8 * CameraCovariance::Identity());
    for (int i = 0; i < 20; ++i) {
      // A depth that was measured to 2 cm.
      const Vector2d pixel(30 + 60 * (i % 5), 30 + 55 * (i / 5));
      const double z = 1 + 0.25 * (i % 4);
      const Vector3d ray = unproject(filter_.camera(), pixel);
      const double along = ray.norm();
      constexpr double kDepthSigma = 0.02;
      const auto id =
          filter_.add_point(pixel, (z + kDepthSigma * gaussian()) * along, kDepthSigma * along);
      // The pixel has its noise, too.
      const Vector2d true_pixel = pixel + kPixelSigma * Vector2d(gaussian(), gaussian());
      places_.emplace_back(*id, z * unproject(filter_.camera(), true_pixel));
    }
  }

  // The squared error of the pose, in units of its claimed covariance.
  double step() {
    constexpr double kSeconds = 1.0 / 30;
    const MotionNoise noise{0.5, 0.5, 0};
    for (int axis = 0; axis < 3; ++axis) {
      truth_.velocity[axis] += noise.acceleration * kSeconds * gaussian();
      truth_.angular_velocity[axis] += noise.angular_acceleration * kSeconds * gaussian();
    }
    truth_ = moved(truth_, kSeconds, std::nullopt);
    filter_.predict(kSeconds, noise, std::nullopt);
    std::vector<Measurement> measurements;
    std::vector<int> all;
    for (const auto& [id, place] : places_) {
      const auto prediction = filter_.predict(id);
      const auto pixel = project(filter_.camera(), truth_.world_from_camera().inverse() * place);
      if (!prediction || !pixel || !filter_.camera().contains(*pixel)) continue;
      all.push_back(static_cast<int>(measurements.size()));
      measurements.push_back(
          {*prediction, *pixel + kPixelSigma * Vector2d(gaussian(), gaussian())});
    }
    filter_.innovation(measurements);
    filter_.update(all);
    const Vector6d error = difference(truth_, filter_.camera_state()).head<kPoseRows>();
    const Matrix6d covariance = filter_.camera_covariance().topLeftCorner<kPoseRows, kPoseRows>();
    return error.dot(covariance.inverse() * error);
  }

 private:
  double gaussian() { return normal_(random_); }

  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  CameraState truth_;
  Filter filter_;
  std::vector<std::pair<PointId, Vector3d>> places_;
};

// Sixty runs: with 95 % the mean of their six degrees of freedom lies between 5.12 and 6.88.
TEST(FilterConsistency, ItIsAsWrongAsItSays) {
  constexpr unsigned kRuns = 60;
  std::vector<double> mean(kFrames, 0.0);
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    Walk walk(seed);
    for (double& value : mean) value += walk.step() / kRuns;
  }
  int inside = 0;
  for (const double value : mean) {
    if (value > 5.12 && value < 6.88) ++inside;
  }
  EXPECT_GE(inside, 0.9 * kFrames);
  // Frames of a run resemble each other, so all of them say little more than ten would: 2 %.
  EXPECT_NEAR(std::accumulate(mean.begin(), mean.end(), 0.0) / kFrames, 6, 0.4);
}

}  // namespace
}  // namespace armsreach::mono_slam
