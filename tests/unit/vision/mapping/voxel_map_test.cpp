#include "vision/mapping/voxel_map.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include "tests/unit/vision/mapping/shapes.hpp"
#include "vision/mapping/sampler.hpp"

namespace armsreach::mapping {
namespace {

using Eigen::Vector3d;
using test::depth_of;
using test::looking_at;
using test::map_of;
using test::small_camera;

double value(std::int16_t log_odds) {
  return static_cast<double>(log_odds) * static_cast<double>(kLogOddsUnit);
}

template <class F>
void for_each_voxel(const VoxelGrid& grid, F&& f) {
  for (const BlockKey& key : grid.blocks.keys()) {
    const Block& block = *grid.blocks.find(key);
    for (int at = 0; at < kBlockVoxels; ++at) {
      const VoxelInBlock v = voxel_at(at);
      f(Eigen::Vector3i(8 * key.x + v.x, 8 * key.y + v.y, 8 * key.z + v.z), block, at);
    }
  }
}

Vector3d centre(const Eigen::Vector3i& voxel, double s) {
  return s * (voxel.cast<double>() + Vector3d::Constant(0.5));
}

TEST(VoxelMap, OneFrameOfAWallIsTheSensorModelVoxelByVoxel) {
  const double d = 1.237;
  const VoxelMapOptions options;
  const VoxelMap map = map_of(test::plane(Vector3d::UnitZ(), d), {Pose()}, options);
  const Camera camera = small_camera();
  int compared = 0;
  int occupied = 0;
  for_each_voxel(map.grid(), [&](const Eigen::Vector3i& voxel, const Block& block, int at) {
    const Vector3d p = centre(voxel, 0.01);
    const auto pixel = project(camera, p);
    // Away from the image's border, where a voxel may or may not still be seen.
    if (!pixel || pixel->x() < 1 || pixel->y() < 1 || pixel->x() > 78 || pixel->y() > 58) return;
    const SensorModel& model = options.sensor;
    if (std::abs(d - p.z()) > model.band(d, 0.01) - 1e-4) {
      if (std::abs(d - p.z()) > model.band(d, 0.01) + 1e-4) {
        EXPECT_EQ(block.log_odds(at), 0);
      }
      return;
    }
    const double expected = log_odds(model.probability(d, p.z(), 0.01));
    // The table's cells (see HitTable's test); elsewhere the values are exact to the fixed point.
    const bool hit = std::abs(d - p.z()) <= model.margin(d, 0.01);
    EXPECT_NEAR(value(block.log_odds(at)), expected, hit ? 0.2 : 1e-3) << p.transpose();
    occupied += block.log_odds(at) > map.grid().occupied_above;
    ++compared;
  });
  EXPECT_GT(compared, 50'000);
  // 1.35 m x 1.0 m of wall, at least one voxel deep.
  EXPECT_GT(occupied, 12'000);
}

TEST(VoxelMap, SignedDistancesOfASlantedWall) {
  const Vector3d normal = Vector3d(0.5, 0.2, 1).normalized();
  const VoxelMap map = map_of(test::plane(normal, 1.4), {Pose()});
  double worst = 0;
  int compared = 0;
  for_each_voxel(map.grid(), [&](const Eigen::Vector3i& voxel, const Block& block, int at) {
    const double truth = 1.4 - normal.dot(centre(voxel, 0.01));
    if (block.weight(at) == 0 || truth > 0.02) return;  // nearer than the truncation
    worst =
        std::max(worst, std::abs(static_cast<double>(block.distance(at)) / 1024 * 0.01 - truth));
    ++compared;
  });
  EXPECT_GT(compared, 30'000);
  // Each pixel is a plane, so a wall is exact up to float and fixed point; 0.05 mm.
  EXPECT_LT(worst, 5e-5);
}

TEST(VoxelMap, SameOccupiedVoxelsAsStockUpdatesOfTheSameKeys) {
  const test::Shape scene = test::nearest_of(
      {test::plane(Vector3d::UnitZ(), 0), test::box({-0.2, -0.2, 0}, {0.2, 0.1, 0.3})});
  std::vector<Pose> poses;
  for (int i = 0; i < 12; ++i) {
    poses.push_back(looking_at({std::cos(0.1 * i), std::sin(0.1 * i), 0.9}, {0, 0, 0.1}));
  }
  VoxelMapOptions options;
  options.carve_every = 0;  // stock updates have nothing of the kind
  const VoxelMap map = map_of(scene, poses, options);

  octomap::OcTree stock(0.01);
  stock.setClampingThresMin(options.least_certain);
  stock.setClampingThresMax(options.most_certain);
  for (const Pose& pose : poses) {
    // A fresh map holds exactly one frame's updates.
    for_each_voxel(map_of(scene, {pose}, options).grid(),
                   [&](const Eigen::Vector3i& voxel, const Block& block, int at) {
                     if (block.log_odds(at) == 0) return;
                     const octomap::OcTreeKey key(static_cast<std::uint16_t>(voxel.x() + 32768),
                                                  static_cast<std::uint16_t>(voxel.y() + 32768),
                                                  static_cast<std::uint16_t>(voxel.z() + 32768));
                     stock.updateNode(key, static_cast<float>(value(block.log_odds(at))), true);
                   });
  }
  const float threshold = static_cast<float>(log_odds(options.occupied_above));
  int both = 0;
  int either = 0;
  for_each_voxel(map.grid(), [&](const Eigen::Vector3i& voxel, const Block& block, int at) {
    const auto* node =
        stock.search(octomap::OcTreeKey(static_cast<std::uint16_t>(voxel.x() + 32768),
                                        static_cast<std::uint16_t>(voxel.y() + 32768),
                                        static_cast<std::uint16_t>(voxel.z() + 32768)));
    const bool ours = block.log_odds(at) > map.grid().occupied_above;
    const bool theirs = node && node->getLogOdds() > threshold;
    both += ours && theirs;
    either += ours || theirs;
  });
  EXPECT_GT(either, 20'000);
  // Fixed point decides the few voxels whose sum lies on the threshold.
  EXPECT_GT(static_cast<double>(both) / either, 0.995);
}

TEST(VoxelMap, WhatWasCarriedAwayIsForgotten) {
  const test::Shape table = test::plane(Vector3d::UnitZ(), 0);
  const test::Shape with_box =
      test::nearest_of({table, test::box({-0.1, -0.1, 0}, {0.1, 0.1, 0.25})});
  const Pose pose = looking_at({0.7, -0.6, 0.9}, {0, 0, 0});
  VoxelMap map = map_of(with_box, std::vector<Pose>(10, pose));
  const auto above_table = [&] {
    int count = 0;
    for_each_voxel(map.grid(), [&](const Eigen::Vector3i& voxel, const Block& block, int at) {
      count += voxel.z() > 3 && block.log_odds(at) > map.grid().occupied_above;
    });
    return count;
  };
  ASSERT_GT(above_table(), 500);
  const Camera camera = small_camera();
  const cv::Mat depth = depth_of(table, camera, pose);
  // From certainty 3.5 at -0.41 a frame it takes nine; every second one carves.
  for (int i = 0; i < 20; ++i) map.insert(depth, cv::Mat(), cv::Mat(), camera, pose);
  EXPECT_EQ(above_table(), 0);
}

TEST(VoxelMap, UntrustedPixelsAddNoSurfaceButStillCarve) {
  const test::Shape wall = test::plane(Vector3d::UnitZ(), 1.5);
  const Camera camera = small_camera();
  VoxelMap map = map_of(wall, std::vector<Pose>(3, Pose()));
  const auto occupied_before = [&](double z) {
    int count = 0;
    for_each_voxel(map.grid(), [&](const Eigen::Vector3i& voxel, const Block& block, int at) {
      count += centre(voxel, 0.01).z() < z && block.log_odds(at) > map.grid().occupied_above;
    });
    return count;
  };
  const cv::Mat hand(60, 80, CV_32FC1, cv::Scalar(0.8F));
  const cv::Mat none(60, 80, CV_32FC1, cv::Scalar(0.0F));
  map.insert(hand, cv::Mat(), none, camera, Pose());
  EXPECT_EQ(occupied_before(1.4), 0);
  map.insert(hand, cv::Mat(), cv::Mat(), camera, Pose());
  EXPECT_GT(occupied_before(1.4), 1000);
  const cv::Mat far = depth_of(wall, camera, Pose());
  for (int i = 0; i < 20; ++i) map.insert(far, cv::Mat(), none, camera, Pose());
  EXPECT_EQ(occupied_before(1.4), 0);
}

TEST(VoxelMap, SnapshotsStayAsTheyWereTaken) {
  const Camera camera = small_camera();
  const test::Shape wall = test::plane(Vector3d::UnitZ(), 1);
  VoxelMap map = map_of(wall, {Pose()});
  const VoxelGrid snapshot = map.snapshot();
  std::map<BlockKey, Block> copy;
  for (const BlockKey& key : snapshot.blocks.keys()) copy[key] = *snapshot.blocks.find(key);

  const cv::Mat nearer = depth_of(test::plane(Vector3d::UnitZ(), 0.97), camera, Pose());
  for (int i = 0; i < 5; ++i) map.insert(nearer, cv::Mat(), cv::Mat(), camera, Pose());

  EXPECT_EQ(snapshot.blocks.keys().size(), copy.size());
  for (const auto& [key, block] : copy) {
    EXPECT_EQ(std::memcmp(snapshot.blocks.find(key)->cubes, block.cubes, sizeof(block.cubes)), 0);
  }
  EXPECT_FALSE(map.take_changed().empty());
  EXPECT_TRUE(map.take_changed().empty());
}

TEST(VoxelMap, MemoryStaysInItsBoundAndTheNewestIsKept) {
  VoxelMapOptions options;
  options.max_blocks = 800;
  const test::Shape wall = test::plane(Vector3d::UnitY(), 1);
  VoxelMap map(options);
  const Camera camera = small_camera();
  for (int i = 0; i < 40; ++i) {
    const Pose pose = looking_at({0.3 * i, 0, 0}, {0.3 * i, 1, 0});
    map.insert(depth_of(wall, camera, pose), cv::Mat(), cv::Mat(), camera, pose);
    EXPECT_LE(map.grid().blocks.block_count(), 800U);
  }
  Sampler sampler(map.grid());
  EXPECT_TRUE(sampler.voxel(1170, 99, 0)) << "in view last";
  EXPECT_FALSE(sampler.voxel(0, 99, 0)) << "left long ago";
}

TEST(VoxelMap, BadDepthIsNoDepth) {
  const Camera camera = small_camera();
  cv::Mat depth(60, 80, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  depth.at<float>(10, 10) = 0;
  depth.at<float>(10, 11) = -1;
  depth.at<float>(10, 12) = std::numeric_limits<float>::infinity();
  depth.at<float>(10, 13) = 100;  // beyond max_range
  VoxelMap map{VoxelMapOptions()};
  map.insert(depth, cv::Mat(), cv::Mat(), camera, Pose());
  EXPECT_EQ(map.grid().blocks.block_count(), 0U);
}

TEST(VoxelMap, FarFromTheOriginItMapsAsWellAndBeyondItsLimitsNothing) {
  const test::Shape wall = test::plane(Vector3d::UnitZ(), 301);
  const VoxelMap map = map_of(wall, {Pose(Eigen::Quaterniond::Identity(), {200, -200, 300})});
  EXPECT_GT(map.grid().blocks.block_count(), 130U) << "1.1 m x 0.8 m of wall";
  const VoxelMap beyond = map_of(test::plane(Vector3d::UnitZ(), 401),
                                 {Pose(Eigen::Quaterniond::Identity(), {0, 0, 400})});
  EXPECT_EQ(beyond.grid().blocks.block_count(), 0U);
}

}  // namespace
}  // namespace armsreach::mapping
