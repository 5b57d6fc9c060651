#include "vision/mapping/map_view.hpp"

#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "tests/unit/vision/mapping/shapes.hpp"

namespace armsreach::mapping {
namespace {

using Eigen::Vector3d;
using test::looking_at;
using test::map_of;

// A table top at z = 0 with a box (a mug's size) on it, seen from around one side.
class TableWithBox : public testing::Test {
 protected:
  static constexpr double kHeight = 0.12;

  TableWithBox()
      : map_(map_of(test::nearest_of({test::plane(Vector3d::UnitZ(), 0),
                                      test::box({-0.04, -0.04, 0}, {0.04, 0.04, kHeight})}),
                    poses())),
        view_(map_.snapshot(), 7) {}

  static std::vector<Pose> poses() {
    std::vector<Pose> poses;
    for (int i = 0; i < 20; ++i) {
      const double a = -1.2 + 0.05 * i;
      poses.push_back(looking_at({0.8 * std::cos(a), 0.8 * std::sin(a), 0.7}, {0, 0, 0.05}));
    }
    return poses;
  }

  VoxelMap map_;
  MapView view_;
};

TEST_F(TableWithBox, PickMeetsTheTableAndTheBox) {
  const Vector3d eye(0.7, -0.3, 0.8);
  for (const Vector3d& target :
       {Vector3d(0.2, 0.1, 0), Vector3d(0.15, -0.2, 0), Vector3d(0, 0, kHeight)}) {
    // Any length of direction means the same ray.
    const auto hit = view_.pick({eye, 0.01 * (target - eye)}, 3);
    ASSERT_TRUE(hit);
    EXPECT_LT((*hit - target).norm(), 0.002) << target.transpose();
  }
  EXPECT_FALSE(view_.pick({eye, Vector3d(0, 0, 1)}, 3)) << "into the air";
  EXPECT_FALSE(view_.pick({eye, Vector3d(0.2, 0.1, 0) - eye}, 0.5)) << "out of range";
  EXPECT_FALSE(view_.pick({eye, Vector3d::Zero()}, 3));
}

TEST_F(TableWithBox, NearestIsOnTheSurface) {
  const auto on_table = view_.nearest({0.25, 0.1, 0.06}, 0.2);
  ASSERT_TRUE(on_table);
  // Surface points lie a voxel apart, so the nearest is up to 7 mm beside the foot.
  EXPECT_LT((*on_table - Vector3d(0.25, 0.1, 0)).norm(), 0.0075);
  EXPECT_NEAR(on_table->z(), 0, 0.001);
  const auto on_top = view_.nearest({0, 0, kHeight + 0.05}, 0.2);
  ASSERT_TRUE(on_top);
  EXPECT_NEAR(on_top->z(), kHeight, 0.002);
  EXPECT_FALSE(view_.nearest({0.25, 0.1, 0.3}, 0.2));
}

TEST_F(TableWithBox, TheTablesPlaneIsNotTiltedByWhatStandsOnIt) {
  // 6 cm beside the box's wall, and with the box well inside the radius.
  for (const Vector3d& foot : {Vector3d(0.1, 0, 0), Vector3d(0.08, -0.08, 0)}) {
    const auto plane = view_.local_plane(foot, 0.12);
    ASSERT_TRUE(plane);
    EXPECT_GT(plane->normal_in_world.z(), std::cos(0.01)) << "0.6 deg";
    EXPECT_NEAR(plane->point_in_world.z(), 0, 0.001);
    EXPECT_LT((plane->point_in_world - foot).norm(), 0.002);
  }
}

TEST_F(TableWithBox, WallsHavePlanesFacingWhereTheyWereSeenFrom) {
  const auto wall = view_.local_plane({0.04, 0, 0.07}, 0.035);
  ASSERT_TRUE(wall);
  EXPECT_GT(wall->normal_in_world.x(), 0.98);
}

TEST_F(TableWithBox, NothingWhereNothingIsPlane) {
  EXPECT_FALSE(view_.local_plane({0.3, 0, 0.5}, 0.1)) << "air";
  const VoxelMap ball = map_of(test::sphere({0, 0, 0}, 0.06), poses());
  const MapView view(VoxelGrid(ball.grid()), 0);
  EXPECT_FALSE(view.local_plane({0.06 * 0.7, 0, 0.06 * 0.7}, 0.1)) << "a ball";
}

TEST_F(TableWithBox, AnchorsStayAndTheRevisionIsTold) {
  const Pose pose(Eigen::Quaterniond::Identity(), {1, 2, 3});
  EXPECT_EQ(view_.resolve(view_.anchor(pose)).translation(), Vector3d(1, 2, 3));
  EXPECT_EQ(view_.revision(), 7U);
}

TEST_F(TableWithBox, AskingFromAThreadWhileTheMapGrows) {
  const Vector3d eye(0.7, -0.3, 0.8);
  const Ray ray{eye, Vector3d(0.2, 0.1, 0) - eye};
  const auto before = view_.pick(ray, 3);
  int same = 0;
  std::thread asker([&] {
    for (int i = 0; i < 200; ++i) same += view_.pick(ray, 3) == before;
  });
  const Camera camera = test::small_camera();
  const cv::Mat depth(60, 80, CV_32FC1, cv::Scalar(0.6F));
  for (int i = 0; i < 20; ++i) {
    map_.insert(depth, cv::Mat(), cv::Mat(), camera, looking_at(eye, {0, 0, 0}));
  }
  asker.join();
  EXPECT_EQ(same, 200);
}

TEST(Surface, PointsOfASphereLieOnItAndFaceOutwards) {
  std::vector<Pose> poses;
  for (int i = 0; i < 40; ++i) {
    const double a = 0.16 * i;
    poses.push_back(looking_at({std::cos(a), std::sin(a), 0.5 * std::sin(3 * a)}, {0, 0, 0}));
  }
  const VoxelMap map = map_of(test::sphere({0, 0, 0}, 0.2), poses);
  int points = 0;
  int inexact = 0;
  int askew = 0;
  for (const BlockKey& key : map.grid().blocks.keys()) {
    for (const SurfacePoint& p : surface_points(map.grid(), key)) {
      ++points;
      inexact += std::abs(p.point_in_world.norm() - 0.2F) > 0.002F;
      askew += p.normal_in_world.dot(p.point_in_world.normalized()) < 0.9F;
    }
  }
  // 4 pi (20 voxels)^2 = 5027 voxels of surface, and 1.5 cells for each as it lies across them; the
  // poles are not seen.
  EXPECT_GT(points, 5000);
  EXPECT_LT(points, 8500);
  // Where it was only ever seen along its outline, a 12 mm pixel is steeper than a plane can say.
  EXPECT_LT(inexact, points / 20);
  EXPECT_LT(askew, points / 50);
}

TEST(Surface, ChangedBlocksNameThoseWhosePointsReachIntoThem) {
  const VoxelMap map = map_of(test::plane(Vector3d::UnitZ(), 1), {Pose()});
  const BlockKey key{0, 0, 12};
  ASSERT_TRUE(map.grid().blocks.find(key));
  const std::vector<BlockKey> keys = changed_surface(map.grid(), {key});
  EXPECT_GE(keys.size(), 4U) << "a wall one block deep";
  EXPECT_EQ(keys.back(), key);
  EXPECT_EQ(changed_surface(map.grid(), {{99, 99, 99}}).size(), 1U) << "dropped blocks are named";
}

}  // namespace
}  // namespace armsreach::mapping
