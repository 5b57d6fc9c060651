#include "vision/gesture/reach.hpp"

#include <cstdint>
#include <limits>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace armsreach::gesture {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// A hand at half a metre before a wall at two, with the shadow of the depth sensor beside it.
cv::Mat depth_of_hand() {
  cv::Mat depth(120, 160, CV_32F, cv::Scalar(2));
  depth(cv::Rect(60, 40, 43, 40)).setTo(kUnknown);
  depth(cv::Rect(63, 40, 40, 40)).setTo(0.5F);
  return depth;
}

TEST(WithinReach, WhatIsFarIsNoHandAndNeitherIsItsEdge) {
  const cv::Mat everything(240, 320, CV_8UC1, cv::Scalar(255));
  const cv::Mat near = within_reach(everything, depth_of_hand(), 0.9);
  const cv::Mat hand = near(cv::Rect(126, 80, 80, 80));
  EXPECT_EQ(cv::countNonZero(hand), 80 * 80);
  // Of the shadow, two pixels of depth beside the hand may stay: its own edge has no depth either.
  EXPECT_LE(cv::countNonZero(near) - 80 * 80, 4 * 80);
}

TEST(WithinReach, WhatIsTooNearToHaveDepthStays) {
  cv::Mat depth(120, 160, CV_32F, cv::Scalar(2));
  depth(cv::Rect(40, 30, 60, 60)).setTo(kUnknown);
  const cv::Mat everything(120, 160, CV_8UC1, cv::Scalar(255));
  const cv::Mat near = within_reach(everything, depth, 0.9);
  EXPECT_EQ(near.at<std::uint8_t>(60, 70), 255);
  EXPECT_EQ(near.at<std::uint8_t>(10, 10), 0);
}

}  // namespace
}  // namespace armsreach::gesture
