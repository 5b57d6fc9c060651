// Which blocks one depth image may touch.
#pragma once

#include <vector>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/mapping/block.hpp"
#include "vision/mapping/depth_planes.hpp"
#include "vision/mapping/sensor_model.hpp"

namespace armsreach::mapping {

// Every block that meets the band around a known pixel's depth inside that pixel's cone; sorted,
// each once, and a few neighbours that only come close. `planes` are in voxel edges.
std::vector<BlockKey> band_blocks(const DepthPlanes& planes, const Camera& camera,
                                  const Pose& world_from_camera, const SensorModel& sensor,
                                  double voxel);

}  // namespace armsreach::mapping
