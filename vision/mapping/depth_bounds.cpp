#include "vision/mapping/depth_bounds.hpp"

#include <bit>
#include <cmath>

#include "vision/mapping/tile_span.hpp"
#include "vision/mapping/view_frustum.hpp"

namespace armsreach::mapping {

DepthBounds::DepthBounds(const VoxelGrid& grid, const Camera& camera, const Pose& world_from_camera)
    : camera_(camera),
      tile_(std::max(1, camera.width / 80)),
      columns_((camera.width + tile_ - 1) / tile_),
      rows_((camera.height + tile_ - 1) / tile_),
      tiles_(static_cast<std::size_t>(columns_) * rows_) {
  const Pose camera_from_world = world_from_camera.inverse();
  const double edge = kBlockEdge * grid.resolution;
  // The surface between two voxels belongs to the block of either.
  const auto radius = static_cast<float>(std::sqrt(0.75) * (edge + grid.resolution));
  for_occupied_in_view(grid, camera, camera_from_world, [&](const BlockKey& key) {
    add((camera_from_world * block_centre(key, edge)).cast<float>(), radius);
  });
}

void DepthBounds::add(const Eigen::Vector3f& centre, float radius) {
  Interval interval{std::max(centre.z() - radius, 0.0F), centre.z() + radius};
  if (interval.far <= 0) return;
  TileSpan span{0, columns_ - 1, 0, rows_ - 1};
  if (interval.near > 0.1F * radius) {
    span = tiles_of_sphere(camera_, tile_, columns_, rows_, centre, radius);
  }
  for (int row = span.top; row <= span.bottom; ++row) {
    Interval* line = &tiles_[static_cast<std::size_t>(row) * columns_];
    for (int column = span.left; column <= span.right; ++column) {
      line[column].near = std::min(line[column].near, interval.near);
      line[column].far = std::max(line[column].far, interval.far);
    }
  }
}

}  // namespace armsreach::mapping
