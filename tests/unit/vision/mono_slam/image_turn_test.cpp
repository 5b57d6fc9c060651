#include "vision/mono_slam/image_turn.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/cameras.hpp"
#include "tests/unit/vision/mono_slam/pictures.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

// Far around the camera; rad to the right and downwards by pixels.
const cv::Mat& surroundings() {
  static const cv::Mat image = test::speckles(1600, 800, 5, 9);
  return image;
}

cv::Mat picture(const Camera& camera, const Quaterniond& world_from_camera) {
  cv::Mat x(camera.height, camera.width, CV_32F), y = x.clone(), out;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vector3d ray = world_from_camera * unproject(camera, {u, v});
      const double scale = 400;  // px / rad
      x.at<float>(v, u) = static_cast<float>(800 + scale * std::atan2(ray.x(), ray.z()));
      y.at<float>(v, u) =
          static_cast<float>(400 + scale * std::atan2(ray.y(), std::hypot(ray.x(), ray.z())));
    }
  }
  cv::remap(surroundings(), out, x, y, cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return out;
}

// Taken while the camera goes on turning.
cv::Mat smeared(const Camera& camera, const Quaterniond& middle, const Vector3d& turn) {
  constexpr int kMoments = 9;
  cv::Mat sum(camera.height, camera.width, CV_32F, cv::Scalar(0)), out;
  for (int i = 0; i < kMoments; ++i) {
    const double share = (i - (kMoments - 1) / 2.0) / kMoments;
    cv::accumulate(picture(camera, middle * so3_exp(share * turn)), sum);
  }
  sum.convertTo(out, CV_8U, 1.0 / kMoments);
  return out;
}

double apart(const Quaterniond& a, const Quaterniond& b) {
  return so3_log(a.conjugate() * b).norm();
}

TEST(ImageTurn, IsMeasuredInPicturesThatAFastTurnHasSmeared) {
  for (const Camera& camera : test::cameras()) {
    ImageTurnMeter meter(camera);
    const Vector3d turn(0.01, 10 * kDegree, -0.02);  // a frame, at 300 degrees a second,
    const Vector3d exposed = 0.18 * turn;            // of which 6 ms are exposed
    meter.take(smeared(camera, Quaterniond::Identity(), exposed));
    EXPECT_FALSE(meter.measure(so3_exp(turn)));
    meter.take(smeared(camera, so3_exp(turn), exposed));
    const Quaterniond expected = so3_exp(turn) * so3_exp({0.8 * kDegree, -1 * kDegree, 0.01});
    const auto seen = meter.measure(expected);
    ASSERT_TRUE(seen);
    // A tenth of a pixel of the 160 that the finer picture is wide.
    EXPECT_LT(apart(seen->before_from_after, so3_exp(turn)), 0.05 * kDegree);
    EXPECT_LT(std::sqrt(seen->covariance.trace()), 0.1 * kDegree);
  }
}

TEST(ImageTurn, AChangeOfTheLightIsNoTurn) {
  const Camera camera = test::cameras()[2];
  ImageTurnMeter meter(camera);
  const cv::Mat image = picture(camera, Quaterniond::Identity());
  meter.take(image);
  meter.take(image * 0.9 + 8);
  const auto seen = meter.measure(so3_exp({0, 0.01, 0}));
  ASSERT_TRUE(seen);
  EXPECT_LT(apart(seen->before_from_after, Quaterniond::Identity()), 0.05 * kDegree);
}

TEST(ImageTurn, NothingIsToldWherePicturesShareTooLittleOrShowNothing) {
  const Camera camera = test::cameras()[2];
  ImageTurnMeter meter(camera);
  meter.take(picture(camera, Quaterniond::Identity()));
  meter.take(picture(camera, so3_exp({0, 1, 0})));
  EXPECT_FALSE(meter.measure(so3_exp({0, 1, 0})));
  const cv::Mat nothing(camera.height, camera.width, CV_8UC1, cv::Scalar(90));
  meter.take(nothing);
  meter.take(nothing);
  EXPECT_FALSE(meter.measure(Quaterniond::Identity()));
}

}  // namespace
}  // namespace armsreach::mono_slam
