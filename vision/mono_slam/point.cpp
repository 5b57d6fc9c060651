#include "vision/mono_slam/point.hpp"

#include <cassert>
#include <cmath>

namespace armsreach::mono_slam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// A point in the camera's frame, up to a positive factor, with the Jacobians of exactly that.
struct Seen {
  Vector3d in_camera;
  Matrix3d by_position;  // of the camera
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMostPointRows> by_point;
};

std::optional<Sighting> projected(const Camera& camera, const Seen& seen) {
  Eigen::Matrix<double, 2, 3> pixel_by_point;
  const auto pixel = project(camera, seen.in_camera, &pixel_by_point);
  if (!pixel) return std::nullopt;
  Sighting out;
  out.pixel = *pixel;
  out.by_pose.leftCols<3>() = pixel_by_point * seen.by_position;
  // camera_from_world = Exp(-turn) * estimate
  out.by_pose.rightCols<3>() = pixel_by_point * skew(seen.in_camera);
  out.by_point = pixel_by_point * seen.by_point;
  return out;
}

}  // namespace

std::optional<Sighting> sighting(const Camera& camera, const CameraState& state,
                                 const Point& point) {
  assert(point.kind != PointKind::ray);
  const Matrix3d camera_from_world = state.rotation.toRotationMatrix().transpose();
  const Vector3d origin = point.values.head<3>() - state.position;
  Seen seen;
  if (point.kind == PointKind::position) {
    seen.in_camera = camera_from_world * origin;
    seen.by_position = -camera_from_world;
    seen.by_point = camera_from_world;
    return projected(camera, seen);
  }
  const double inverse = point.values[5];
  seen.in_camera = camera_from_world * (inverse * origin + point.direction());
  seen.by_position = -inverse * camera_from_world;
  seen.by_point.resize(3, 6);
  seen.by_point << inverse * camera_from_world, camera_from_world * point.axes.rightCols<2>(),
      camera_from_world * origin;
  return projected(camera, seen);
}

std::optional<Sighting> sighting_along(const Camera& camera, const CameraState& state,
                                       const Point& ray, double distance) {
  const Matrix3d camera_from_world = state.rotation.toRotationMatrix().transpose();
  Seen seen;
  seen.in_camera = camera_from_world * (ray.at(distance) - state.position);
  seen.by_position = -camera_from_world;
  seen.by_point.resize(3, 5);
  seen.by_point << camera_from_world, distance * camera_from_world * ray.axes.rightCols<2>();
  return projected(camera, seen);
}

NewRay ray_through(const Camera& camera, const CameraState& state, const Vector2d& pixel) {
  Eigen::Matrix2d ray_by_pixel;
  const Vector3d ray = unproject(camera, pixel, &ray_by_pixel);
  const double length = ray.norm();
  const Vector3d unit = ray / length;
  const Matrix3d unit_by_ray = (Matrix3d::Identity() - unit * unit.transpose()) / length;
  const Matrix3d world_from_camera = state.rotation.toRotationMatrix();

  NewRay out;
  out.point.kind = PointKind::ray;
  out.point.values = PointVector::Zero(5);
  out.point.values.head<3>() = state.position;
  out.point.axes.col(0) = world_from_camera * unit;
  // The camera's y axis is never along a ray that the camera sees.
  const Vector3d across = world_from_camera * Vector3d::UnitY().cross(unit).normalized();
  out.point.axes.col(1) = across;
  out.point.axes.col(2) = out.point.axes.col(0).cross(across);

  const Eigen::Matrix<double, 2, 3> across_by_unit =
      out.point.axes.rightCols<2>().transpose() * world_from_camera;
  out.by_pose.setZero();
  out.by_pose.topLeftCorner<3, 3>().setIdentity();
  out.by_pose.bottomRightCorner<2, 3>() = -across_by_unit * skew(unit);
  out.by_pixel.setZero();
  out.by_pixel.bottomRows<2>() = across_by_unit * unit_by_ray.leftCols<2>() * ray_by_pixel;
  return out;
}

}  // namespace armsreach::mono_slam
