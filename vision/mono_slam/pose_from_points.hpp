// The pose of a camera from points it sees: refinement with its covariance, and from scratch.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::mono_slam {

struct SeenPoint {
  Eigen::Vector3d point_in_world;
  Eigen::Vector2d pixel;
};

struct PoseFix {
  Pose world_from_camera;
  // Of position and turn, as in the filter's state, for one pixel's deviation.
  Matrix6d covariance;
  double rms = 0;  // px
};

// Least squares over all points, from a pose that is nearly right. Nothing when it diverges or the
// points do not determine a pose.
std::optional<PoseFix> refined_pose(const Camera& camera, const Pose& world_from_camera,
                                    const std::vector<SeenPoint>& points);

// Up to four poses that show three points at these pixels.
std::vector<Pose> three_point_poses(const Camera& camera, const std::vector<SeenPoint>& points);

}  // namespace armsreach::mono_slam
