// A mapped point as the filter holds it, and where it is seen.
//
// A point starts on the ray it was first seen along. The ray has an origin and a direction, which
// is written as axes.col(0) + a axes.col(1) + b axes.col(2) with a fixed orthonormal frame around
// the first direction: two numbers without a pole. Distances are along the ray.
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "vision/core/camera.hpp"
#include "vision/mono_slam/camera_motion.hpp"

namespace armsreach::mono_slam {

enum class PointKind {
  position,       // x y z
  ray,            // origin, a, b; the distance is known elsewhere (DepthParticles)
  inverse_depth,  // origin, a, b, 1 / distance (Civera, Davison, Montiel, TRO 2008)
};
inline constexpr int kMostPointRows = 6;
constexpr int rows_of(PointKind kind) {
  return kind == PointKind::position ? 3 : kind == PointKind::ray ? 5 : 6;
}

using PointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostPointRows, 1>;
using PointJacobian = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMostPointRows>;

struct Point {
  PointKind kind = PointKind::position;
  PointVector values = PointVector::Zero(3);
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // of rays: the frame of the direction

  Eigen::Vector3d direction() const {  // of rays; nearly unit
    return axes * Eigen::Vector3d(1, values[3], values[4]);
  }
  Eigen::Vector3d at(double distance) const { return values.head<3>() + distance * direction(); }
  // In the world, m. Not of rays.
  Eigen::Vector3d position() const {
    return kind == PointKind::position ? Eigen::Vector3d(values.head<3>()) : at(1 / values[5]);
  }
};

struct Sighting {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, kCameraRows> by_camera;  // by the error of its state
  PointJacobian by_point;                           // by `values`
};

// Where the point is seen; nothing when behind the camera or beyond the lens's angle. Not of rays.
std::optional<Sighting> sighting(const Camera& camera, const CameraState& state,
                                 const Point& point);
// The same of the place at a distance [m] along a ray.
std::optional<Sighting> sighting_along(const Camera& camera, const CameraState& state,
                                       const Point& ray, double distance);

// The ray through a pixel, its values' Jacobians by the error of the camera's state and by the
// pixel.
struct NewRay {
  Point point;
  Eigen::Matrix<double, 5, kCameraRows> by_camera;
  Eigen::Matrix<double, 5, 2> by_pixel;
};
NewRay ray_through(const Camera& camera, const CameraState& state, const Eigen::Vector2d& pixel);

}  // namespace armsreach::mono_slam
