#include "devices/sim/color_sensor.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace armsreach::sim {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

SensorDescription with(const ColorDescription& color) {
  SensorDescription sensor;
  sensor.width = kWidth;
  sensor.height = kHeight;
  sensor.rate = 30;
  sensor.color = color;
  return sensor;
}

cv::Mat grey(double level) {
  return cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(level, level, level));
}
cv::Mat random_picture() {
  cv::Mat picture(kHeight, kWidth, CV_8UC3);
  cv::theRNG().state = 5;
  cv::randu(picture, 0, 256);
  return picture;
}
double mean_of(const cv::Mat& picture) { return cv::mean(picture.reshape(1))[0]; }
double deviation_of(const cv::Mat& picture) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(picture.reshape(1), mean, deviation);
  return deviation[0];
}

TEST(ColorSensor, ACleanOneChangesNothing) {
  const cv::Mat picture = random_picture();
  ColorSensor sensor(with(kCleanColor), 1);
  for (const std::int64_t frame : {0, 7})
    EXPECT_EQ(cv::norm(sensor.measure(picture, 0.3, frame), picture, cv::NORM_INF), 0);
}

// Shot noise of light is alike in its square root; read noise shows where there is little light.
TEST(ColorSensor, NoiseIsAsStatedAtEveryBrightness) {
  ColorDescription color = kCleanColor;
  color.noise = 2;
  ColorSensor sensor(with(color), 1);
  EXPECT_NEAR(sensor.noise_at(200), 2, 0.02);
  EXPECT_GT(sensor.noise_at(5), 1.5 * sensor.noise_at(100));
  for (const double level : {20.0, 40.0, 80.0, 120.0, 180.0, 230.0}) {
    const cv::Mat measured = sensor.measure(grey(level), 0, static_cast<std::int64_t>(level));
    const double stated = sensor.noise_at(level);
    // 230 400 samples leave 0.15 % of chance; rounding to whole levels adds 1/12 to the variance;
    // the root is bent, which matters by the square of noise over level.
    const double bent = stated / level * stated / level;
    EXPECT_NEAR(deviation_of(measured), std::sqrt(stated * stated + 1.0 / 12),
                stated * (0.01 + 3 * bent))
        << level;
    EXPECT_NEAR(mean_of(measured), level * (1 - bent / 2), 0.05) << level;
  }
}

TEST(ColorSensor, NoiseIsTheSameForASeedAndFrameOnly) {
  ColorDescription color = kCleanColor;
  color.noise = 2;
  const auto measured = [&](std::uint64_t seed, std::int64_t frame) {
    return ColorSensor(with(color), seed).measure(grey(100), 0, frame);
  };
  EXPECT_EQ(cv::norm(measured(1, 4), measured(1, 4), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(measured(1, 4), measured(1, 5), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(measured(1, 4), measured(2, 4), cv::NORM_INF), 0);
}

// A lamp goes out: the exposure makes up for 63 % of it (of its logarithm) in the stated time.
TEST(ColorSensor, ExposureFollowsTheLightWithALag) {
  ColorDescription color = kCleanColor;
  color.exposure_lag = 0.5;
  ColorSensor sensor(with(color), 1);
  EXPECT_NEAR(mean_of(sensor.measure(grey(150), 0, 0)), 118, 1)
      << "settled from the first frame on";
  std::vector<double> levels;
  for (int frame = 1; frame <= 90; ++frame)
    levels.push_back(mean_of(sensor.measure(grey(75), frame / 30.0, frame)));
  EXPECT_NEAR(levels[0], 59, 1) << "half the level at the same exposure";
  const double after = std::log(levels[15] / levels[0]);
  EXPECT_NEAR(after / std::log(118.0 / 59), 1 - std::exp(-1), 0.03);
  EXPECT_NEAR(levels.back(), 118, 1);
}

TEST(ColorSensor, ExposureHasItsLimits) {
  ColorDescription color = kCleanColor;
  color.exposure_lag = 0.5;
  ColorSensor sensor(with(color), 1);
  EXPECT_NEAR(mean_of(sensor.measure(grey(20), 0, 0)), 40, 1) << "two stops are twice the root";
}

// Largest relative change of light in a minute, for the mean of all colours and for red over blue.
TEST(ColorSensor, BrightnessAndWhiteBalanceDriftAsStated) {
  ColorDescription color = kCleanColor;
  color.exposure_drift = 0.1;
  color.white_balance_drift = 0.05;
  ColorSensor sensor(with(color), 3);
  double brightness = 0;
  double warmth = 0;
  double step = 0;
  double before = 0;
  for (int frame = 0; frame < 60 * 30; ++frame) {
    const cv::Scalar mean = cv::mean(sensor.measure(grey(120), frame / 30.0, frame));
    const double now = std::pow(mean[1] / 120, 2) - 1;
    if (frame > 0) step = std::max(step, std::abs(now - before));
    before = now;
    brightness = std::max(brightness, std::abs(now));
    warmth = std::max(warmth, std::abs(mean[2] / mean[0] - 1));
  }
  // The waves need not all crest at once; one level of 120 is 1.7 % of light.
  EXPECT_LT(brightness, 0.1 + 0.01);
  EXPECT_GT(brightness, 0.05);
  // Values are roots of light, so (1 + w) / (1 - w) of light is about 1 + w of values.
  EXPECT_LT(warmth, 0.05 + 0.01);
  EXPECT_GT(warmth, 0.025);
  EXPECT_LT(step, 0.02) << "no jump from frame to frame but of a grey level";
}

TEST(ColorSensor, JpegTakesMoreAwayAtLowerQuality) {
  cv::Mat picture = random_picture();
  cv::GaussianBlur(picture, picture, {}, 1.5);
  std::size_t larger = 1U << 30;
  double closer = 0;
  for (const int quality : {95, 80, 50, 20}) {
    ColorDescription color = kCleanColor;
    color.jpeg_quality = quality;
    ColorSensor sensor(with(color), 1);
    const cv::Mat measured = sensor.measure(picture, 0, 0);
    const double error = cv::norm(measured, picture, cv::NORM_L2);
    // What it looks like after compression takes as many bytes again.
    std::vector<std::uint8_t> file;
    cv::imencode(".jpg", measured, file, {cv::IMWRITE_JPEG_QUALITY, quality});
    EXPECT_LT(file.size(), larger) << quality;
    EXPECT_GT(error, closer) << quality;
    larger = file.size();
    closer = error;
  }
}

}  // namespace
}  // namespace armsreach::sim
