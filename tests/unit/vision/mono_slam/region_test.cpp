#include "vision/mono_slam/region.hpp"

#include <set>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace armsreach::mono_slam {
namespace {

using Pixels = std::set<std::pair<int, int>>;

Pixels pixels_of(const Region& region) {
  Pixels out;
  for (std::size_t i = 0; i < region.spans.size(); ++i) {
    for (int x = region.spans[i].begin; x < region.spans[i].end; ++x) {
      out.emplace(x, region.top + static_cast<int>(i));
    }
  }
  return out;
}

TEST(Region, AnEllipseHoldsExactlyThePixelsWithinTheDeviations) {
  Eigen::Matrix2d covariance;
  covariance << 9, 4, 4, 3;
  const Eigen::Vector2d centre(40.3, 30.8);
  Pixels expected;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 80; ++x) {
      const Eigen::Vector2d d = Eigen::Vector2d(x, y) - centre;
      if (d.dot(covariance.inverse() * d) <= 9) expected.emplace(x, y);
    }
  }
  EXPECT_EQ(pixels_of(ellipse(centre, covariance, 3)), expected);
}

TEST(Region, AnEndlessEllipseIsTheWholeImage) {
  const Region all = ellipse({100, 100}, 1e9 * Eigen::Matrix2d::Identity(), 3);
  EXPECT_EQ(within(all, 320, 240, 7).area(), (320 - 14) * (240 - 14));
}

TEST(Region, AMergedOneHoldsBoth) {
  const Region a = square({20, 20}, 3);
  const Region b = square({30, 25}, 4);
  const Pixels merged_pixels = pixels_of(merged(a, b));
  for (const Region& part : {a, b}) {
    for (const auto& pixel : pixels_of(part)) EXPECT_TRUE(merged_pixels.count(pixel));
  }
  EXPECT_EQ(pixels_of(merged(Region(), a)), pixels_of(a));
}

TEST(Region, HalvedHoldsTheHalfOfEveryPixel) {
  const Region region = ellipse({33.4, 21.7}, 30 * Eigen::Matrix2d::Identity(), 2);
  Pixels expected;
  for (const auto& [x, y] : pixels_of(region)) expected.emplace(x / 2, y / 2);
  EXPECT_EQ(pixels_of(halved(region)), expected);
}

}  // namespace
}  // namespace armsreach::mono_slam
