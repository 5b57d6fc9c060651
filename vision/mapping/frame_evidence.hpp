// Puts a frame and the map's options into the form that the inner loop of insertion reads.
#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/mapping/depth_planes.hpp"
#include "vision/mapping/sensor_model.hpp"
#include "vision/mapping/update_block.hpp"
#include "vision/mapping/voxel_map.hpp"

namespace armsreach::mapping {

// Points into `hits`, `planes` and `intensity` (CV_32F, continuous, or empty), which must live on.
FrameEvidence frame_evidence(const VoxelMapOptions& options, const HitTable& hits,
                             const DepthPlanes& planes, const cv::Mat& intensity,
                             const Camera& camera, const Pose& camera_from_world);

}  // namespace armsreach::mapping
