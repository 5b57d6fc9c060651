#include "vision/core/pyramid.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace armsreach {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

TEST(Pyramid, AnEdgeKeepsTheNearSurface) {
  cv::Mat depth(4, 8, CV_32F, cv::Scalar(2.0));
  depth.col(2).setTo(1.0);
  const cv::Mat small = reduced_depth(depth, 4);
  EXPECT_FLOAT_EQ(small.at<float>(0, 0), 1.0F);
  EXPECT_FLOAT_EQ(small.at<float>(0, 1), 2.0F);
}

TEST(Pyramid, ASlopeIsAveraged) {
  cv::Mat depth(4, 4, CV_32F);
  for (int col = 0; col < 4; ++col) depth.col(col).setTo(1.0 + 0.005 * col);
  EXPECT_NEAR(reduced_depth(depth, 4).at<float>(0, 0), 1.0075, 1e-6);
}

TEST(Pyramid, NoiseIsAveragedAndNotCutOff) {
  // A plane at 1.5 m under six times a Kinect's noise, 1.9 cm: its nearest samples alone, within 3
  // % of the very nearest, would put it 2 cm too near.
  const double noise = 6 * kKinectDepthNoise;
  const double z = 1.5;
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, noise * z * z);
  cv::Mat depth(64, 64, CV_32F);
  for (int row = 0; row < 64; ++row) {
    for (int col = 0; col < 64; ++col) {
      depth.at<float>(row, col) = static_cast<float>(z + normal(random));
    }
  }
  // 64 blocks of 64 samples: the mean deviates by 0.3 mm.
  EXPECT_NEAR(cv::mean(reduced_depth(depth, 8, noise))[0], z, 1e-3);
  EXPECT_LT(cv::mean(reduced_depth(depth, 8))[0], z - 0.002);
}

TEST(Pyramid, HolesStayHoles) {
  cv::Mat depth(8, 8, CV_32F, cv::Scalar(kUnknown));
  depth.at<float>(0, 0) = 1;  // 1 of 64 samples is no surface
  EXPECT_TRUE(std::isnan(reduced_depth(depth, 8).at<float>(0, 0)));
  depth(cv::Rect(0, 0, 8, 2)).setTo(1);  // a quarter is
  EXPECT_FLOAT_EQ(reduced_depth(depth, 8).at<float>(0, 0), 1);
  depth.setTo(0);
  EXPECT_TRUE(std::isnan(reduced_depth(depth, 8).at<float>(0, 0)));
}

TEST(Pyramid, IntensityIsTheBlockMeanOfGrey) {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar(255, 255, 255));
  image(cv::Rect(0, 0, 320, 480)).setTo(0);
  const cv::Mat small = reduced_intensity(image, 8);
  ASSERT_EQ(small.size(), cv::Size(80, 60));
  EXPECT_NEAR(small.at<float>(10, 10), 0, 1e-6);
  EXPECT_NEAR(small.at<float>(10, 70), 1, 1e-6);
  EXPECT_FLOAT_EQ(reduced_intensity(cv::Mat(240, 320, CV_8UC1, cv::Scalar(51)), 4).at<float>(0, 0),
                  0.2F);
}

}  // namespace
}  // namespace armsreach
