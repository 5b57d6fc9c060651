// The map of real recordings, with their true poses.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/recorded_views.hpp"
#include "tests/support/recordings.hpp"
#include "vision/mapping/mesh.hpp"
#include "vision/mapping/ray_cast.hpp"
#include "vision/mapping/voxel_map.hpp"

namespace armsreach::mapping {
namespace {

TEST(MapOfLivingroom, ReferenceDepthIsTrueToAFractionOfAVoxel) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  const auto recording = test::recorded_views(path, 80, 40, 1);
  VoxelMap map{VoxelMapOptions()};
  std::vector<double> errors;
  std::size_t far_off = 0;
  std::size_t unseen = 0;
  for (const test::RecordedView& frame : recording.views) {
    map.insert(frame.depth, frame.intensity, cv::Mat(), recording.camera, frame.world_from_camera);
    const ReferenceView view = cast(map.grid(), recording.camera, frame.world_from_camera);
    for (int v = 0; v < 60; ++v) {
      for (int u = 0; u < 80; ++u) {
        const double truth = static_cast<double>(frame.depth.at<float>(v, u));
        const double error = std::abs(static_cast<double>(view.depth.at<float>(v, u)) - truth);
        if (!(truth > 0)) continue;
        unseen += !(error >= 0);
        if (!(error >= 0)) continue;
        errors.push_back(error);
        far_off += error > 0.02;
      }
    }
  }
  std::sort(errors.begin(), errors.end());
  RecordProperty("median_mm", std::to_string(errors[errors.size() / 2] * 1e3));
  // Measured 0.18 mm, and 2 % of pixels, all on outlines, over 2 cm off.
  EXPECT_LT(errors[errors.size() / 2], 4e-4);
  EXPECT_LT(static_cast<double>(far_off) / static_cast<double>(errors.size()), 0.04);
  EXPECT_LT(static_cast<double>(unseen) / static_cast<double>(errors.size()), 0.03);
}

TEST(MapOfRedkitchen, TakesThePromisedMemoryPerSquareMetre) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  const auto recording = test::recorded_views(path, 80, 40, 1);
  VoxelMap map{VoxelMapOptions()};
  for (const test::RecordedView& frame : recording.views) {
    map.insert(frame.depth, frame.intensity, cv::Mat(), recording.camera, frame.world_from_camera);
  }
  std::size_t occupied = 0;
  for (const BlockKey& key : map.grid().blocks.keys()) {
    occupied += map.grid().blocks.find(key)->occupied;
  }
  EXPECT_GT(occupied, map.grid().blocks.block_count() / 2) << "most blocks hold surface";
  const double bytes = static_cast<double>(map.grid().blocks.block_count() * sizeof(Block));
  const double square_metres = area(surface_mesh(map.grid()));
  RecordProperty("MB_per_m2", std::to_string(bytes / 1e6 / square_metres));
  // Measured 2.4; over the whole recording, seen from more sides, 1.9.
  EXPECT_GT(square_metres, 4);
  EXPECT_LT(bytes / square_metres, 2.8e6);
}

}  // namespace
}  // namespace armsreach::mapping
