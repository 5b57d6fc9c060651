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

Seen seen_from(const CameraState& state, const Point& point) {
  const Matrix3d camera_from_world = state.rotation.toRotationMatrix().transpose();
  const Vector3d origin = point.values.head<3>() - state.position;
  Seen seen;
  if (point.kind == PointKind::position) {
    seen.in_camera = camera_from_world * origin;
    seen.by_position = -camera_from_world;
    seen.by_point = camera_from_world;
    return seen;
  }
  const double inverse = point.values[5];
  seen.in_camera = camera_from_world * (inverse * origin + point.direction());
  seen.by_position = -inverse * camera_from_world;
  seen.by_point.resize(3, 6);
  seen.by_point << inverse * camera_from_world, camera_from_world * point.axes.rightCols<2>(),
      camera_from_world * origin;
  return seen;
}

Seen seen_along(const CameraState& state, const Point& ray, double distance) {
  const Matrix3d camera_from_world = state.rotation.toRotationMatrix().transpose();
  Seen seen;
  seen.in_camera = camera_from_world * (ray.at(distance) - state.position);
  seen.by_position = -camera_from_world;
  seen.by_point.resize(3, 5);
  seen.by_point << camera_from_world, distance * camera_from_world * ray.axes.rightCols<2>();
  return seen;
}

// As at one moment: by_camera has the pose's columns only.
std::optional<Sighting> projected(const Camera& camera, const Seen& seen) {
  Eigen::Matrix<double, 2, 3> pixel_by_point;
  const auto pixel = project(camera, seen.in_camera, &pixel_by_point);
  if (!pixel) return std::nullopt;
  Sighting out;
  out.pixel = *pixel;
  out.by_camera.setZero();
  out.by_camera.leftCols<3>() = pixel_by_point * seen.by_position;
  // camera_from_world = Exp(-turn) * estimate
  out.by_camera.middleCols<3>(3) = pixel_by_point * skew(seen.in_camera);
  out.by_point = pixel_by_point * seen.by_point;
  return out;
}

// The camera when a line is read, half a readout before the middle one to half after.
struct AtLine {
  CameraState state;
  CameraCovariance by_state;  // Jacobian, the line being given
  CameraError by_line;        // of the same error, by the line
};

AtLine at_line(const Camera& camera, const CameraState& state, double line) {
  const double share = (line - 0.5 * (camera.height - 1)) / camera.height;
  AtLine out;
  out.state = moved(state, share * state.readout, std::nullopt, &out.by_state);
  CameraError by_time;
  by_time << state.velocity, state.angular_velocity, 0, 0, 0, 0, 0, 0, 0;
  out.by_state.col(kReadoutRow) += share * by_time;
  out.by_line = state.readout / camera.height * by_time;
  return out;
}

// `seen` shows the point from a state. Which line it is on is not known before it is projected: the
// one that the middle line's pose shows it on is near enough.
template <class SeenFrom>
std::optional<Sighting> on_its_line(const Camera& camera, const CameraState& state,
                                    SeenFrom seen_from_state) {
  const auto first = projected(camera, seen_from_state(state));
  if (!first) return std::nullopt;
  const AtLine at = at_line(camera, state, first->pixel.y());
  auto out = projected(camera, seen_from_state(at.state));
  if (!out) return std::nullopt;
  const Vector2d by_line = out->by_camera * at.by_line;
  out->by_camera = out->by_camera * at.by_state + by_line * first->by_camera.row(1);
  out->by_point += by_line * first->by_point.row(1);
  return out;
}

}  // namespace

std::optional<Sighting> sighting(const Camera& camera, const CameraState& state,
                                 const Point& point) {
  assert(point.kind != PointKind::ray);
  return on_its_line(camera, state, [&](const CameraState& s) { return seen_from(s, point); });
}

std::optional<Sighting> sighting_along(const Camera& camera, const CameraState& state,
                                       const Point& ray, double distance) {
  return on_its_line(camera, state,
                     [&](const CameraState& s) { return seen_along(s, ray, distance); });
}

NewRay ray_through(const Camera& camera, const CameraState& state, const Vector2d& pixel) {
  Eigen::Matrix2d ray_by_pixel;
  const Vector3d ray = unproject(camera, pixel, &ray_by_pixel);
  const double length = ray.norm();
  const Vector3d unit = ray / length;
  const Matrix3d unit_by_ray = (Matrix3d::Identity() - unit * unit.transpose()) / length;
  const AtLine at = at_line(camera, state, pixel.y());
  const Matrix3d world_from_camera = at.state.rotation.toRotationMatrix();

  NewRay out;
  out.point.kind = PointKind::ray;
  out.point.values = PointVector::Zero(5);
  out.point.values.head<3>() = at.state.position;
  out.point.axes.col(0) = world_from_camera * unit;
  // The camera's y axis is never along a ray that the camera sees.
  const Vector3d across = world_from_camera * Vector3d::UnitY().cross(unit).normalized();
  out.point.axes.col(1) = across;
  out.point.axes.col(2) = out.point.axes.col(0).cross(across);

  const Eigen::Matrix<double, 2, 3> across_by_unit =
      out.point.axes.rightCols<2>().transpose() * world_from_camera;
  Eigen::Matrix<double, 5, kPoseRows> by_pose = Eigen::Matrix<double, 5, kPoseRows>::Zero();
  by_pose.topLeftCorner<3, 3>().setIdentity();
  by_pose.bottomRightCorner<2, 3>() = -across_by_unit * skew(unit);
  out.by_camera = by_pose * at.by_state.topRows<kPoseRows>();
  out.by_pixel.setZero();
  out.by_pixel.bottomRows<2>() = across_by_unit * unit_by_ray.leftCols<2>() * ray_by_pixel;
  out.by_pixel.col(1) += by_pose * at.by_line.head<kPoseRows>();
  return out;
}

}  // namespace armsreach::mono_slam
