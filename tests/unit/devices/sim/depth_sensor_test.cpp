#include "devices/sim/depth_sensor.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace armsreach::sim {
namespace {

constexpr double kFocal = 525;
constexpr int kWidth = 640;
constexpr int kHeight = 480;

SensorDescription kinect() {
  SensorDescription sensor;
  sensor.nearest = 0.6;
  sensor.farthest = 6;
  return sensor;
}

cv::Mat wall_at(float depth) { return cv::Mat(kHeight, kWidth, CV_32F, cv::Scalar(depth)); }
cv::Mat bright() { return cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(255)); }
double share_unknown(const cv::Mat& depth) {
  return 1 -
         static_cast<double>(cv::countNonZero(depth == depth)) / static_cast<double>(depth.total());
}

struct Statistics {
  double mean;
  double deviation;
};
Statistics statistics(const cv::Mat& values) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(values, mean, deviation);
  return {mean[0], deviation[0]};
}

TEST(DepthSensor, NoiseGrowsWithTheSquareOfDepth) {
  const DepthSensor sensor(kinect(), kFocal, 1);
  // Depths half-way inside a step of disparity and on its edge alike, hence the mean over several.
  for (const float depth : {0.7F, 1.0F, 1.5F, 2.0F, 3.0F, 5.0F}) {
    double power = 0;
    double bias = 0;
    constexpr int kDepths = 20;
    for (int i = 0; i < kDepths; ++i) {
      const float z = depth * (1 + 0.0017F * static_cast<float>(i));
      const cv::Mat measured = sensor.measure(wall_at(z), bright(), i);
      ASSERT_LT(share_unknown(measured), 0.001);
      const Statistics s = statistics((measured - z) / (z * z));
      power += (s.deviation * s.deviation + s.mean * s.mean) / kDepths;
      bias += s.mean / kDepths;
    }
    // 20 frames of neighbouring, hence alike, pixels leave about 2 % of chance.
    EXPECT_NEAR(std::sqrt(power), 1.425e-3, 0.05 * 1.425e-3) << depth;
    EXPECT_LT(std::abs(bias), 0.1 * 1.425e-3) << depth;
  }
}

TEST(DepthSensor, TheFactorScalesTheNoise) {
  SensorDescription description = kinect();
  description.noise = 6;
  description.nearest = 0.25;
  const DepthSensor sensor(description, kFocal, 1);
  double power = 0;
  for (int i = 0; i < 20; ++i) {
    const float z = 0.7F * (1 + 0.002F * static_cast<float>(i));
    const Statistics s = statistics((sensor.measure(wall_at(z), bright(), i) - z) / (z * z));
    power += (s.deviation * s.deviation + s.mean * s.mean) / 20;
  }
  EXPECT_NEAR(std::sqrt(power), 6 * 1.425e-3, 0.05 * 6 * 1.425e-3);
}

TEST(DepthSensor, DisparityComesInWholeSteps) {
  const DepthSensor sensor(kinect(), kFocal, 1);
  const cv::Mat measured = sensor.measure(wall_at(2), bright(), 0);
  for (int x = 0; x < kWidth; ++x) {
    const double steps = 1 / (2 * 1.425e-3 * static_cast<double>(measured.at<float>(7, x)));
    EXPECT_NEAR(steps, std::round(steps), 1e-3);  // single precision of 1/z near 175 steps
  }
}

TEST(DepthSensor, NothingOutsideTheRange) {
  const DepthSensor sensor(kinect(), kFocal, 1);
  EXPECT_EQ(share_unknown(sensor.measure(wall_at(0.59F), bright(), 0)), 1);
  EXPECT_LT(share_unknown(sensor.measure(wall_at(0.61F), bright(), 0)), 0.001);
  EXPECT_EQ(share_unknown(sensor.measure(wall_at(7), bright(), 0)), 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(share_unknown(sensor.measure(wall_at(nan), bright(), 0)), 1);
}

TEST(DepthSensor, AnExactSensorOnlyCutsItsRange) {
  SensorDescription description = kinect();
  description.noise = 0;
  const DepthSensor sensor(description, kFocal, 1);
  cv::Mat exact = wall_at(1.2345F);
  exact.at<float>(0, 0) = 0.5F;
  exact.at<float>(0, 1) = 9;
  const cv::Mat measured = sensor.measure(exact, 0 * bright(), 0);
  EXPECT_TRUE(std::isnan(measured.at<float>(0, 0)));
  EXPECT_TRUE(std::isnan(measured.at<float>(0, 1)));
  EXPECT_EQ(measured.at<float>(0, 2), 1.2345F);
  EXPECT_EQ(cv::countNonZero(measured == measured), kWidth * kHeight - 2);
}

// A board in front of a wall: the projector on the camera's right leaves a strip of the wall on the
// board's left without light, f b (1/near - 1/far) wide.
TEST(DepthSensor, EdgesHaveHolesAndTheShadowLiesOnTheLeft) {
  const DepthSensor sensor(kinect(), kFocal, 1);
  constexpr double kNear = 1;
  constexpr double kFar = 2;
  cv::Mat exact = wall_at(static_cast<float>(kFar));
  exact(cv::Rect(300, 0, 100, kHeight)).setTo(kNear);
  const cv::Mat measured = sensor.measure(exact, bright(), 0);
  const int shadow = static_cast<int>(kFocal * 0.075 * (1 / kNear - 1 / kFar));  // 19 px
  for (int y = 0; y < kHeight; ++y) {
    const float* row = measured.ptr<float>(y);
    for (int x = 300 - shadow; x <= 300; ++x) ASSERT_TRUE(std::isnan(row[x])) << x << " " << y;
    EXPECT_FALSE(std::isnan(row[300 - shadow - 3]));
    EXPECT_FALSE(std::isnan(row[302]));
    EXPECT_TRUE(std::isnan(row[399]));
    EXPECT_TRUE(std::isnan(row[400]));
    EXPECT_FALSE(std::isnan(row[402]));
  }
}

// A floor that falls away from the camera: from h above it, row v sees it at z = f h / v.
cv::Mat floor_below(double height) {
  cv::Mat exact(kHeight, kWidth, CV_32F);
  for (int y = 0; y < kHeight; ++y) exact.row(y).setTo(kFocal * height / (y + 60.0));
  return exact;
}

TEST(DepthSensor, GrazingLightDoesNotComeBack) {
  SensorDescription description = kinect();
  description.farthest = 1000;
  const DepthSensor sensor(description, kFocal, 1);
  // cos of the angle of incidence, as the slope per pixel gives it, is v / sqrt(v^2 + f^2): under
  // the threshold of 0.2 +- 0.03 for v < 107, that is for rows above 47.
  const cv::Mat measured = sensor.measure(floor_below(0.7), bright(), 0);
  EXPECT_GT(share_unknown(measured.rowRange(0, 20)), 0.95);
  EXPECT_LT(share_unknown(measured.rowRange(100, kHeight - 1)), 0.01);
}

TEST(DepthSensor, DarkThingsHaveNoDepth) {
  const DepthSensor sensor(kinect(), kFocal, 1);
  cv::Mat returned = bright();
  returned(cv::Rect(0, 0, 320, kHeight)).setTo(20);  // 8 %
  const cv::Mat measured = sensor.measure(wall_at(1), returned, 0);
  EXPECT_GT(share_unknown(measured.colRange(0, 320)), 0.99);
  EXPECT_LT(share_unknown(measured.colRange(320, kWidth)), 0.001);
}

// What comes back must exceed 0.2 +- 0.03 of a white surface's: the share of pixels with depth is
// the normal distribution of that.
TEST(DepthSensor, TheDarkerAMaterialTheMoreHoles) {
  const DepthSensor sensor(kinect(), kFocal, 1);
  double before = 1.1;
  for (const double share : {0.35, 0.26, 0.23, 0.2, 0.17, 0.14, 0.05}) {
    const cv::Mat returned(kHeight, kWidth, CV_8U, cv::Scalar(std::round(255 * share)));
    const double unknown = share_unknown(sensor.measure(wall_at(1.5F), returned, 0));
    const double sigmas = (0.2 - std::round(255 * share) / 255) / 0.03;
    const double expected = 0.5 * std::erfc(-sigmas / std::sqrt(2.0));
    // Neighbours are alike: some 60 000 independent samples, drawn into a tile of fewer.
    EXPECT_NEAR(unknown, expected, 0.015) << share;
    EXPECT_LE(1 - unknown, before) << share;
    before = 1 - unknown;
  }
}

// Of a material that is seen at all, the noise is that of its range, not of its brightness; and
// hidden pixels leave the others' errors as they are.
TEST(DepthSensor, NoiseDoesNotDependOnTheMaterial) {
  const DepthSensor sensor(kinect(), kFocal, 1);
  for (const int returned : {100, 170, 255}) {
    double power = 0;
    for (int i = 0; i < 20; ++i) {
      const float z = 1.5F * (1 + 0.0017F * static_cast<float>(i));
      const cv::Mat measured =
          sensor.measure(wall_at(z), cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(returned)), i);
      ASSERT_LT(share_unknown(measured), 0.001);
      const Statistics s = statistics((measured - z) / (z * z));
      power += (s.deviation * s.deviation + s.mean * s.mean) / 20;
    }
    EXPECT_NEAR(std::sqrt(power), 1.425e-3, 0.05 * 1.425e-3) << returned;
  }
}

// The shadow of a nearer thing is f b (1/near - 1/far) px wide whatever the depths, and what is lit
// beside it is measured as well as anywhere.
TEST(DepthSensor, TheShadowIsAsWideAsTheDepthsSay) {
  const DepthSensor sensor(kinect(), kFocal, 1);
  for (const auto& [near, far] : {std::pair{0.7, 0.9}, {0.8, 1.6}, {1.2, 3.0}, {2.0, 2.5}}) {
    cv::Mat exact = wall_at(static_cast<float>(far));
    exact(cv::Rect(300, 0, 100, kHeight)).setTo(near);
    const cv::Mat measured = sensor.measure(exact, bright(), 0);
    double width = 0;
    for (int y = 0; y < kHeight; ++y) {
      int x = 299;
      while (std::isnan(measured.at<float>(y, x))) --x;
      width += static_cast<double>(299 - x) / kHeight;
    }
    // Whole pixels, and one that is lost to the edge itself.
    EXPECT_NEAR(width, kFocal * 0.075 * (1 / near - 1 / far), 1.5) << near << " " << far;
    const cv::Mat beside = measured(cv::Rect(100, 0, 100, kHeight));
    EXPECT_LT(share_unknown(beside), 0.001);
    const Statistics s = statistics(beside - far);
    EXPECT_LT(std::hypot(s.mean, s.deviation), 1.9 * 1.425e-3 * far * far) << "one step at most";
  }
}

TEST(DepthSensor, IsTheSameForASeedAndFrameOnly) {
  const cv::Mat wall = wall_at(1.5F);
  const cv::Mat a = DepthSensor(kinect(), kFocal, 1).measure(wall, bright(), 4);
  const cv::Mat b = DepthSensor(kinect(), kFocal, 1).measure(wall, bright(), 4);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(a, DepthSensor(kinect(), kFocal, 1).measure(wall, bright(), 5)), 0);
  EXPECT_GT(cv::norm(a, DepthSensor(kinect(), kFocal, 2).measure(wall, bright(), 4)), 0);
}

}  // namespace
}  // namespace armsreach::sim
