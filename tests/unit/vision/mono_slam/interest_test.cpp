#include "vision/mono_slam/interest.hpp"

#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/pictures.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;

cv::Mat white_square() {
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar(40));
  image(cv::Rect(100, 80, 60, 50)) = 200;
  return image;
}

std::vector<Vector2d> found(const cv::Mat& grey, const cv::Mat& allowed, int tries) {
  std::mt19937_64 random(1);
  std::vector<Vector2d> out;
  for (int i = 0; i < tries; ++i) {
    const auto pixel = interesting_pixel(grey, allowed, out, InterestOptions(), &random);
    if (pixel) out.push_back(*pixel);
  }
  return out;
}

TEST(Interest, FindsTheCornersOfASquareAndNothingElse) {
  const auto pixels = found(white_square(), {}, 300);
  EXPECT_EQ(pixels.size(), 4U);
  for (const Vector2d& pixel : pixels) {
    const double x = std::min(std::abs(pixel.x() - 99.5), std::abs(pixel.x() - 159.5));
    const double y = std::min(std::abs(pixel.y() - 79.5), std::abs(pixel.y() - 129.5));
    EXPECT_LT(std::hypot(x, y), 5);
  }
}

TEST(Interest, KeepsItsDistanceAndSpreads) {
  const auto pixels = found(test::speckles(320, 240, 2), {}, 60);
  EXPECT_GT(pixels.size(), 40U);
  int left = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (pixels[i].x() < 160) ++left;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE((pixels[i] - pixels[j]).norm(), InterestOptions().spacing);
    }
  }
  EXPECT_NEAR(left, static_cast<double>(pixels.size()) / 2,
              0.2 * static_cast<double>(pixels.size()));
}

TEST(Interest, StaysWhereItIsAllowed) {
  cv::Mat allowed(240, 320, CV_8UC1, cv::Scalar(0));
  allowed(cv::Rect(0, 0, 160, 240)) = 255;
  for (const Vector2d& pixel : found(test::speckles(320, 240, 2), allowed, 60)) {
    EXPECT_LT(pixel.x(), 160);
  }
}

TEST(Interest, FindsNothingOnAWall) {
  EXPECT_TRUE(found(cv::Mat(240, 320, CV_8UC1, cv::Scalar(120)), {}, 50).empty());
}

}  // namespace
}  // namespace armsreach::mono_slam
