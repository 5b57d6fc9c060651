#include "vision/alignment/sensor_noise.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/synthetic_room.hpp"

namespace armsreach {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

cv::Mat depth_of(const test::SyntheticRoom& room, int index) {
  const Pose looking_down(so3_exp({-0.25, 0.1, 0}), Eigen::Vector3d(0, -0.5, 0.3));
  return room.frame(test::synthetic_sensor(), looking_down, index)->depth;
}

// Of a camera that knows depth in steps of constant disparity only.
cv::Mat in_steps(const cv::Mat& depth, float step) {
  cv::Mat out = depth.clone();
  for (int row = 0; row < out.rows; ++row) {
    for (int col = 0; col < out.cols; ++col) {
      float& z = out.at<float>(row, col);
      z = 1 / (step * std::round(1 / (step * z)));
    }
  }
  return out;
}

TEST(SensorNoise, IsTheKinectsUntilSomethingIsSeen) {
  SensorNoise noise;
  noise.learn(cv::Mat());
  noise.learn(cv::Mat(480, 640, CV_32F, cv::Scalar(kUnknown)));
  EXPECT_EQ(noise.k(), kKinectDepthNoise);
}

TEST(SensorNoise, IsFoundInSlantedFurnishedRooms) {
  for (const double k : {0.7e-3, 1.425e-3, 8.55e-3}) {
    test::SyntheticRoom room;
    room.depth_noise = k;
    SensorNoise noise;
    for (int i = 0; i < 5; ++i) noise.learn(depth_of(room, i));
    EXPECT_NEAR(noise.k(), k,
                0.15 * k);  // edges are a little more than the fifth left out, or less
  }
}

TEST(SensorNoise, OfDepthInStepsIsThatOfItsRounding) {
  test::SyntheticRoom room;
  room.depth_noise = 1.425e-3;
  const float step = 2.85e-3F;  // 1/m: a Kinect's
  SensorNoise noise;
  for (int i = 0; i < 5; ++i) noise.learn(in_steps(depth_of(room, i), step));
  // Rounding adds the variance of a uniform deviate a step wide.
  const double expected = std::hypot(room.depth_noise, 2.85e-3 / std::sqrt(12.0));
  EXPECT_NEAR(noise.k(), expected, 0.2 * expected);
}

TEST(SensorNoise, OfAnExactCameraIsNone) {
  SensorNoise noise;
  noise.learn(depth_of(test::SyntheticRoom(), 0));
  EXPECT_LT(noise.k(), 0.05 * kKinectDepthNoise);
}

}  // namespace
}  // namespace armsreach
