// What is pointed at.
#include "vision/gesture/pointing.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

constexpr double kRight = std::numbers::pi / 2;

TEST(Pointing, TheWedgesAxisTurnsClockwiseFromUp) {
  EXPECT_NEAR((Wedge{{0, 0}, 0}.axis() - Eigen::Vector2d(0, -1)).norm(), 0, 1e-12);
  EXPECT_NEAR((Wedge{{0, 0}, kRight}.axis() - Eigen::Vector2d(1, 0)).norm(), 0, 1e-12);
}

TEST(Pointing, TheNearestThingInTheWedgeIsMeant) {
  const Wedge wedge{{100, 100}, kRight};
  EXPECT_EQ(in_wedge(wedge, {{{400, 100}, 10}, {{250, 110}, 10}, {{150, 200}, 10}}), 1U);
  EXPECT_EQ(in_wedge(wedge, {{{20, 100}, 10}, {{100, 300}, 10}}), std::nullopt);  // behind, beside
}

TEST(Pointing, ALargeThingNeedOnlyReachIntoTheWedge) {
  const Wedge wedge{{100, 100}, kRight, 0.1};
  EXPECT_EQ(in_wedge(wedge, {{{200, 160}, 10}}), std::nullopt);
  EXPECT_EQ(in_wedge(wedge, {{{200, 160}, 60}}), 0U);
}

TEST(Pointing, WhatTheHandIsInsideOfIsNotMeant) {
  EXPECT_EQ(in_wedge({{100, 100}, kRight}, {{{110, 100}, 30}}), std::nullopt);
}

TEST(Pointing, TheCursorMeansTheNearestWithinReach) {
  EXPECT_EQ(under_cursor({100, 100}, 20, {{{180, 100}, 20}, {{130, 100}, 15}}), 1U);
  EXPECT_EQ(under_cursor({100, 100}, 10, {{{180, 100}, 20}, {{130, 100}, 15}}), std::nullopt);
}

}  // namespace
}  // namespace armsreach::gesture
