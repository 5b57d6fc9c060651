// Between which depths the rays of a view can meet the map at all, from the occupied blocks
// projected into it.
#pragma once

#include <vector>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/mapping/voxel_grid.hpp"

namespace armsreach::mapping {

class DepthBounds {
 public:
  struct Interval {
    float near = 1e9F;  // m along z; nothing to be met when near > far
    float far = -1e9F;
  };

  DepthBounds(const VoxelGrid& grid, const Camera& camera, const Pose& world_from_camera);
  const Interval& at(int u, int v) const {
    return tiles_[static_cast<std::size_t>(v / tile_) * columns_ + u / tile_];
  }

 private:
  void add(const Eigen::Vector3f& centre_in_camera, float radius);

  Camera camera_;
  int tile_;  // px
  int columns_;
  int rows_;
  std::vector<Interval> tiles_;
};

}  // namespace armsreach::mapping
