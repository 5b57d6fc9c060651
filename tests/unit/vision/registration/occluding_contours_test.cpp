#include "vision/registration/occluding_contours.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
const Camera kCamera = pinhole(160, 120, 150, 150, 79.5, 59.5);

// A board at 1 m, columns 60..99 and rows 40..79, before a wall at 2 m.
cv::Mat board() {
  cv::Mat depth(120, 160, CV_32FC1, cv::Scalar(2));
  depth(cv::Rect(60, 40, 40, 40)).setTo(1);
  return depth;
}

TEST(OccludingContours, SurroundTheNearSurfaceAtItsDepth) {
  const auto points = occluding_contours(board(), kCamera, 1000);
  EXPECT_EQ(points.size(), 4 * 40U);
  for (const ContourPoint& point : points) {
    EXPECT_EQ(point.point_in_depth.z(), 1);
    const float across = point.across == Across::columns ? point.pixel.x() : point.pixel.y();
    const float first = point.across == Across::columns ? 59.5F : 39.5F;
    EXPECT_TRUE(across == first || across == first + 40) << across;
    const auto pixel = project(kCamera, point.point_in_depth.cast<double>());
    EXPECT_NEAR((pixel->cast<float>() - point.pixel).norm(), 0, 1e-4);  // float rounding
  }
}

TEST(OccludingContours, ReachAcrossAShadow) {
  cv::Mat depth = board();
  depth(cv::Rect(48, 40, 12, 40)).setTo(kUnknown);  // left of the board
  EXPECT_EQ(occluding_contours(depth, kCamera, 1000).size(), 4 * 40U);
  depth(cv::Rect(30, 40, 30, 40)).setTo(kUnknown);  // too wide to know what was there
  EXPECT_EQ(occluding_contours(depth, kCamera, 1000).size(), 3 * 40U);
}

TEST(OccludingContours, AreNotSlopesSpecksOrFarThings) {
  cv::Mat slope(120, 160, CV_32FC1);
  for (int row = 0; row < 120; ++row) slope.row(row).setTo(1 + 0.015F * static_cast<float>(row));
  EXPECT_TRUE(occluding_contours(slope, kCamera, 1000).empty());
  cv::Mat speck(120, 160, CV_32FC1, cv::Scalar(2));
  speck(cv::Rect(80, 60, 3, 3)).setTo(1);
  EXPECT_TRUE(occluding_contours(speck, kCamera, 1000).empty());
  EXPECT_TRUE(occluding_contours(4.5 * board(), kCamera, 1000).empty());
}

TEST(OccludingContours, AreThinnedEvenly) {
  const auto points = occluding_contours(board(), kCamera, 20);
  ASSERT_EQ(points.size(), 40U);
  EXPECT_LT(points.front().pixel.y(), 44);
  EXPECT_GT(points[19].pixel.y(), 75);
}

}  // namespace
}  // namespace armsreach
