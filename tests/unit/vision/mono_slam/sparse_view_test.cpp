#include "vision/mono_slam/sparse_view.hpp"

#include <gtest/gtest.h>

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector3d;

const Vector3d kUp(0, 1, 0);

MapPoint point(PointId id, const Vector3d& at, PointKind kind = PointKind::position) {
  MapPoint out;
  out.id = id;
  out.kind = kind;
  out.position = at;
  return out;
}

// A wall of 5 x 5 points 10 cm apart in the plane z = 1, seen from the origin.
MonoResult wall() {
  MonoResult result;
  for (int i = 0; i < 25; ++i)
    result.points.push_back(point(i + 1, {0.1 * (i % 5 - 2), 0.1 * (i / 5 - 2), 1}));
  return result;
}

TEST(SparseView, ARayMeetsTheSurfaceThatThePointsSuggest) {
  const WorldViewPtr view = SparseViewMaker().view(wall(), kUp);
  const auto met = view->pick({Vector3d::Zero(), Vector3d(0.04, 0.03, 1)}, 5);
  ASSERT_TRUE(met);
  // Distances of the points around differ by their slant only: 1 % at 8 degrees.
  EXPECT_LT((*met - Vector3d(0.04, 0.03, 1)).norm(), 0.01);
  EXPECT_FALSE(view->pick({Vector3d::Zero(), Vector3d(0, 0, -1)}, 5)) << "behind";
  EXPECT_FALSE(view->pick({Vector3d::Zero(), Vector3d(1, 0, 1)}, 5)) << "25 degrees beside";
  EXPECT_FALSE(view->pick({Vector3d::Zero(), Vector3d(0, 0, 1)}, 0.5)) << "out of range";
}

TEST(SparseView, ThroughAPointTheRayEndsThere) {
  const WorldViewPtr view = SparseViewMaker().view(
      [] {
        MonoResult result = wall();
        result.points.push_back(point(30, {0, 0, 0.5}));
        result.points[12].position.z() = 1.2;  // the one behind it
        return result;
      }(),
      kUp);
  const auto met = view->pick({Vector3d(0, 0.4, 0.5), Vector3d(0, -1, 0)}, 5);
  ASSERT_TRUE(met);
  EXPECT_LT((*met - Vector3d(0, 0, 0.5)).norm(), 0.01);
}

TEST(SparseView, APlaneFacesWhoSawItAndElseIsLevel) {
  const WorldViewPtr flat = SparseViewMaker().view(wall(), kUp);
  const auto plane = flat->local_plane({0.02, 0, 1}, 0.06);
  ASSERT_TRUE(plane);
  EXPECT_LT((plane->normal_in_world - Vector3d(0, 0, -1)).norm(), 1e-6);

  MonoResult clutter;
  for (int i = 0; i < 8; ++i)
    clutter.points.push_back(point(i + 1, {0.1 * (i & 1), 0.1 * (i >> 1 & 1), 1 + 0.1 * (i >> 2)}));
  clutter.world_from_camera = Pose(Eigen::Quaterniond::Identity(), Vector3d(0, 1, 0));
  const auto level = SparseViewMaker().view(clutter, kUp)->local_plane({0.05, 0.05, 1.05}, 0.06);
  ASSERT_TRUE(level);
  EXPECT_EQ(level->normal_in_world, kUp);
  EXPECT_FALSE(flat->local_plane({0, 0, 2}, 0.06)) << "a metre from all points";
}

TEST(SparseView, AnchorsFollowTheirPointAndStayWhenItGoes) {
  SparseViewMaker maker;
  MonoResult result = wall();
  const Pose thing(Eigen::Quaterniond::Identity(), Vector3d(0.01, 0, 1));
  const Anchor anchor = maker.view(result, kUp)->anchor(thing);
  result.points[12].position += Vector3d(0, 0, 0.02);
  const Pose corrected = maker.view(result, kUp)->resolve(anchor);
  EXPECT_LT((corrected.translation() - Vector3d(0.01, 0, 1.02)).norm(), 1e-12);
  result.points.erase(result.points.begin() + 12);
  for (int frame = 0; frame < 3; ++frame) {
    const Pose kept = maker.view(result, kUp)->resolve(anchor);
    EXPECT_LT((kept.translation() - corrected.translation()).norm(), 1e-12);
  }
}

TEST(SparseView, WhatIsNotYetKnownIsNoPlace) {
  MonoResult result;
  result.points.push_back(point(1, {0, 0, 1}, PointKind::inverse_depth));
  const WorldViewPtr view = SparseViewMaker().view(result, kUp);
  EXPECT_FALSE(view->nearest({0, 0, 1}, 1));
  EXPECT_FALSE(view->pick({Vector3d::Zero(), Vector3d(0, 0, 1)}, 5));
  const Pose thing(Eigen::Quaterniond::Identity(), Vector3d(1, 2, 3));
  EXPECT_EQ(view->resolve(view->anchor(thing)).translation(), thing.translation());
}

}  // namespace
}  // namespace armsreach::mono_slam
