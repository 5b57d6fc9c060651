// The cursor's filter: calm at rest, quick in motion, the same at any resolution.
#include "vision/gesture/one_euro.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

constexpr Timestamp kFrame = 33'333'333;
constexpr double kHand = 100;  // px

TEST(OneEuro, TremblingAtRestIsQuieted) {
  OneEuro filter;
  double largest = 0;
  for (int i = 0; i < 90; ++i) {
    const Eigen::Vector2d trembling(200 + (i % 2 ? 2 : -2), 100);
    const Eigen::Vector2d out = filter.filter(trembling, kHand, i * kFrame);
    if (i > 30) largest = std::max(largest, std::abs(out.x() - 200));
  }
  EXPECT_LT(largest, 0.8);  // of 2 px
}

TEST(OneEuro, AFastHandIsFollowedCloselyASlowFilterWouldLag) {
  const auto lag = [](const OneEuroOptions& options) {
    OneEuro filter(options);
    Eigen::Vector2d out;
    double x = 0;
    for (int i = 0; i < 30; ++i) {
      x = 20.0 * i;  // six hands a second
      out = filter.filter({x, 0}, kHand, i * kFrame);
    }
    return x - out.x();
  };
  OneEuroOptions plain;
  plain.beta = 0;
  EXPECT_LT(lag({}), 20);  // less than what it moves in a frame
  EXPECT_GT(lag(plain), 60);
}

TEST(OneEuro, TwiceTheResolutionGivesTwiceTheAnswer) {
  OneEuro small;
  OneEuro large;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d point(30 * std::sin(0.4 * i), 5 * i);
    const Eigen::Vector2d a = small.filter(point, kHand, i * kFrame);
    const Eigen::Vector2d b = large.filter(2 * point, 2 * kHand, i * kFrame);
    EXPECT_NEAR((2 * a - b).norm(), 0, 1e-9);
  }
}

TEST(OneEuro, SwitchedOffItPassesPointsAndATimeThatStandsStillIsSurvived) {
  OneEuroOptions off;
  off.enabled = false;
  OneEuro passing(off);
  passing.filter({0, 0}, kHand, 0);
  EXPECT_EQ(passing.filter({50, 7}, kHand, kFrame), Eigen::Vector2d(50, 7));
  OneEuro filter;
  filter.filter({0, 0}, kHand, kFrame);
  EXPECT_EQ(filter.filter({50, 7}, kHand, kFrame), Eigen::Vector2d(0, 0));
  EXPECT_EQ(filter.filter({50, 7}, kHand, 0), Eigen::Vector2d(0, 0));
}

}  // namespace
}  // namespace armsreach::gesture
