// The occupied blocks that a camera may see.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/mapping/voxel_grid.hpp"

namespace armsreach::mapping {

// Of a block, or of a region with its own edge.
inline Eigen::Vector3d block_centre(const BlockKey& key, double edge) {
  return edge * Eigen::Vector3d(key.x + 0.5, key.y + 0.5, key.z + 0.5);
}

// Calls f(key) for the occupied blocks of every region that reaches into the camera's view.
template <class F>
void for_occupied_in_view(const VoxelGrid& grid, const Camera& camera,
                          const Pose& camera_from_world, F&& f) {
  const double edge = kRegionEdge * kBlockEdge * grid.resolution;
  const double radius = std::sqrt(0.75) * edge;
  const double slope_x = std::max(camera.cx + 0.5, camera.width - 0.5 - camera.cx) / camera.fx;
  const double slope_y = std::max(camera.cy + 0.5, camera.height - 0.5 - camera.cy) / camera.fy;
  const auto beside = [&](double across, double z, double slope) {
    return std::abs(across) > slope * z + radius * std::sqrt(1 + slope * slope);
  };
  grid.blocks.for_each_region([&](const BlockKey& key, const Region& region) {
    if (region.occupied == 0) return;
    const Eigen::Vector3d centre = camera_from_world * block_centre(key, edge);
    if (centre.z() < -radius || beside(centre.x(), centre.z(), slope_x) ||
        beside(centre.y(), centre.z(), slope_y)) {
      return;
    }
    for (std::uint64_t rest = region.occupied; rest != 0; rest &= rest - 1) {
      f(BlockTable::block_at(key, std::countr_zero(rest)));
    }
  });
}

}  // namespace armsreach::mapping
