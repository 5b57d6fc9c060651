#include "devices/sim/infrared/infrared_sensor.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "devices/sim/infrared/infrared_view.hpp"

namespace armsreach::sim {
namespace {

Camera lens() { return pinhole(752, 480, 666.7, 666.7, 375.5, 239.5); }
cv::Mat even_light(double level) { return cv::Mat(480, 752, CV_32F, cv::Scalar(level)); }
const cv::Rect kMiddle(336, 200, 80, 80);  // light there is within 3 % of the centre's

TEST(InfraredSensor, NoiseGrowsWithTheRootOfLight) {
  const InfraredSensor sensor(lens(), 1, 1);
  for (const double level : {0.0, 20.0, 100.0, 200.0}) {
    cv::Scalar mean;
    cv::Scalar deviation;
    const cv::Mat a = sensor.measure(even_light(level), 1)(kMiddle);
    const cv::Mat b = sensor.measure(even_light(level), 2)(kMiddle);
    EXPECT_NEAR(cv::mean(a)[0], 2 + level, 0.02 * level + 0.2) << level;
    // The difference of two frames is free of what stays: columns and vignetting.
    cv::Mat difference;
    cv::subtract(a, b, difference, cv::noArray(), CV_32F);
    cv::meanStdDev(difference, mean, deviation);
    // 6400 pixels leave 1 % of chance, rounding adds 1/12; at 0, some values are cut off at black.
    const double stated = std::sqrt(2 * (level / 45 + 0.7 * 0.7 + 1.0 / 12));
    EXPECT_NEAR(deviation[0], stated, 0.05 * stated) << level;
  }
}

TEST(InfraredSensor, WhatIsFarAboveWhiteIsWhite) {
  const InfraredSensor sensor(lens(), 1, 1);
  double low = 0;
  cv::minMaxLoc(sensor.measure(even_light(900), 0)(kMiddle), &low, nullptr);
  EXPECT_EQ(low, 255);
}

TEST(InfraredSensor, CornersGetLessLight) {
  const InfraredSensor sensor(lens(), 0, 1);
  const cv::Mat image = sensor.measure(even_light(200), 0);
  // cos^6 at 34 deg, by which the corner lies off the axis.
  const double angle = std::atan(std::hypot(375.5, 239.5) / 666.7);
  EXPECT_NEAR(image.at<std::uint8_t>(3, 3) - 2, 200 * std::pow(std::cos(angle), 6), 4);
}

TEST(InfraredSensor, BrightThingsGlow) {
  const InfraredSensor sensor(lens(), 0, 1);
  cv::Mat light = even_light(0);
  light(cv::Rect(356, 220, 40, 40)).setTo(1500);
  const cv::Mat image = sensor.measure(light, 0);
  const int beside = image.at<std::uint8_t>(240, 400);
  EXPECT_GT(beside, 6) << "a glow beside it";
  EXPECT_LT(beside, 60) << "and no more than that";
  EXPECT_LT(static_cast<int>(image.at<std::uint8_t>(240, 460)), 5) << "60 px on there is none";
}

TEST(Tape, ReturnsLittleBeyondFiftyDegrees) {
  const auto at = [](double degrees) { return tape_returns(degrees * std::numbers::pi / 180); };
  EXPECT_GT(at(0), 0.99);
  EXPECT_GT(at(40), 0.95);
  EXPECT_GT(at(50), 0.7);
  EXPECT_LT(at(60), 0.25);
  EXPECT_LT(at(70), 0.03);
}

}  // namespace
}  // namespace armsreach::sim
