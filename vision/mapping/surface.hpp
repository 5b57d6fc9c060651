// The mapped surface as points, block by block: one point in each cell of eight voxel centres that
// the surface passes through (the vertices of Gibson, "Constrained elastic surface nets", 1998).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "vision/mapping/block.hpp"
#include "vision/mapping/voxel_grid.hpp"

namespace armsreach::mapping {

struct SurfacePoint {
  Eigen::Vector3f point_in_world;
  Eigen::Vector3f normal_in_world;  // unit, towards the free side
  float intensity = 0;              // 0..1
};

// Shared between updates: the same pointer means the same content.
struct SurfaceBlock {
  BlockKey key;
  std::vector<SurfacePoint> points;
};
using SurfaceBlockPtr = std::shared_ptr<const SurfaceBlock>;

// A cell that the surface passes through.
struct SurfaceCell {
  std::uint8_t x, y, z;  // its first voxel in the block
  std::uint8_t free;     // bit i: its corner i (x fastest) lies on the free side
};

// Points of the cells whose first voxel lies in the block, x fastest; empty where nothing is
// mapped. `cells`, where given, receives each point's cell.
std::vector<SurfacePoint> surface_points(const VoxelGrid& grid, const BlockKey& key,
                                         std::vector<SurfaceCell>* cells = nullptr);

// The blocks whose points may have changed with these voxels: they and those before them along each
// axis; sorted. Blocks that do not exist are named only where they were among the changed: dropped.
std::vector<BlockKey> changed_surface(const VoxelGrid& grid, const std::vector<BlockKey>& changed);

}  // namespace armsreach::mapping
