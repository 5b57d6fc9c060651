// The picture that a frame is shown as, and its camera: what pixels of hands and clicks refer to.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/tracked_frame.hpp"
#include "vision/core/world_view.hpp"

namespace armsreach::app {

struct BackgroundCamera {
  Camera camera;
  Pose background_from_camera;  // "camera" is the one whose pose is tracked
  bool sees_depth = true;       // its pixels are those of the frame's depth
};

// The colour camera's where there is a colour image, else the depth camera's.
BackgroundCamera background_camera(const Frame& frame);

// Through a pixel of the picture; nothing while the pose is unknown.
std::optional<Ray> ray_through(const TrackedFrame& tracked, const Eigen::Vector2d& pixel);

// What is seen there, by the frame's own depth; nothing while that or the pose is unknown.
std::optional<Eigen::Vector3d> point_in_world_at(const TrackedFrame& tracked,
                                                 const Eigen::Vector2d& pixel);

}  // namespace armsreach::app
