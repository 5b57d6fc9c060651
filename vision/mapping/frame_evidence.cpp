#include "vision/mapping/frame_evidence.hpp"

#include <algorithm>

namespace armsreach::mapping {
namespace {

// Where a block's voxels lie from its first one, for cubes of eight and within one.
void place_lanes(const Eigen::Matrix3d& rotation, FrameEvidence& frame) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 3; ++i) frame.step[axis][i] = static_cast<float>(rotation(i, axis));
  }
  const auto from_first = [&frame](const VoxelInBlock& voxel, int i) {
    return static_cast<float>(voxel.x) * frame.step[0][i] +
           static_cast<float>(voxel.y) * frame.step[1][i] +
           static_cast<float>(voxel.z) * frame.step[2][i];
  };
  for (int i = 0; i < 3; ++i) {
    for (int lane = 0; lane < 8; ++lane) frame.corner[i][lane] = from_first(voxel_at(lane), i);
    const float to_centre = frame.corner[i][7] / 2;
    for (int cube = 0; cube < kBlockVoxels / 8; ++cube) {
      frame.cube[cube][i] = from_first(voxel_at(8 * cube), i);
      frame.centre[i][cube] = frame.cube[cube][i] + to_centre;
    }
  }
  const auto [near, far] = std::minmax_element(frame.corner[2], frame.corner[2] + 8);
  frame.half_depth = (*far - *near) / 2;
}

}  // namespace

FrameEvidence frame_evidence(const VoxelMapOptions& options, const HitTable& hits,
                             const DepthPlanes& planes, const cv::Mat& intensity,
                             const Camera& camera, const Pose& camera_from_world) {
  FrameEvidence frame;
  frame.planes = planes.planes.data();
  frame.intensity = intensity.empty() ? nullptr : intensity.ptr<float>();
  frame.width = planes.width;
  frame.height = planes.height;
  frame.fx = static_cast<float>(camera.fx);
  frame.fy = static_cast<float>(camera.fy);
  frame.cx = static_cast<float>(camera.cx);
  frame.cy = static_cast<float>(camera.cy);
  place_lanes(camera_from_world.rotation_matrix(), frame);
  frame.voxel = static_cast<float>(options.resolution);
  frame.noise = static_cast<float>(options.sensor.noise * options.resolution);
  frame.hits = hits.data();
  frame.free = fixed_log_odds(options.sensor.free);
  frame.lowest = fixed_log_odds(options.least_certain);
  frame.highest = fixed_log_odds(options.most_certain);
  frame.max_weight =
      static_cast<float>(std::min(options.max_weight / static_cast<double>(kWeightUnit), 65535.0));
  frame.intensity_rate = static_cast<float>(options.intensity_rate);
  return frame;
}

}  // namespace armsreach::mapping
