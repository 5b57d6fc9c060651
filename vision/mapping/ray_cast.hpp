// Reference views: what a camera would see of the map.
#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/reference_view.hpp"
#include "vision/mapping/voxel_grid.hpp"

namespace armsreach::mapping {

struct RayCastOptions {
  double near = 0.1;  // m along z
  double far = 8;
  // What the last frame measured and how well it fitted (both CV_32F of the camera's size, or
  // empty). Where the weight is above `sure`, the search starts just in front of that depth.
  cv::Mat expected_depth;
  cv::Mat weights;
  double sure = 0.5;
};

// View of the map from a pinhole camera, sub-voxel depth and interpolated intensity, NaN where
// nothing is mapped. `normals`, when given, becomes CV_32FC3: unit, in the world, NaN unknown.
ReferenceView cast(const VoxelGrid& grid, const Camera& camera, const Pose& world_from_camera,
                   const RayCastOptions& options = {}, cv::Mat* normals = nullptr);

}  // namespace armsreach::mapping
