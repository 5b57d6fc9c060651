#include "render/room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace armsreach::render {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFieldOfView = 0.66;  // rad, of the orbiting view's shorter side

Vector3d unit_normal(const SurfacePoint& point) {
  return Vector3d(point.normal[0], point.normal[1], point.normal[2]).normalized();
}

// Mean of the normals within a cone about `up` that narrows from 45 to 10 degrees.
std::optional<Vector3d> level_up(const Surface& surface, Vector3d up) {
  bool found = false;
  for (const double cone : {0.71, 0.82, 0.90, 0.95, 0.97, 0.985}) {
    Vector3d sum = Vector3d::Zero();
    for (const SurfaceBlockPtr& block : surface.blocks) {
      // Every seventh point is plenty for a mean.
      for (std::size_t i = 0; i < block->points.size(); i += 7) {
        const Vector3d normal = unit_normal(block->points[i]);
        if (normal.dot(up) > cone) sum += normal;
      }
    }
    if (sum.norm() <= 20) continue;
    up = sum.normalized();
    found = true;
  }
  if (!found) return std::nullopt;
  return up;
}

// Shows a camera looking along `forward`: its axes are x right, y down, z forward.
Pose looking(const Vector3d& centre, const Vector3d& forward, const Vector3d& up) {
  Matrix3d axes;
  axes.col(2) = forward.normalized();
  axes.col(0) = forward.cross(up).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return {Eigen::Quaterniond(axes), centre};
}

// Near enough for the nearest thing, far enough for the farthest.
void set_depth_range(View& view, double distance, double radius) {
  view.near = std::max(0.02, distance - 4 * radius);
  view.far = distance + 8 * radius;
}

}  // namespace

std::optional<Vector3d> known_up(const Scene& scene) {
  if (!scene.up_in_world.isZero()) return scene.up_in_world.normalized();
  if (!scene.surface) return std::nullopt;
  return level_up(*scene.surface, -scene.world_from_camera.rotation_matrix().col(1));
}

RoomFromWorld guess_room(const Scene& scene) {
  const Matrix3d world_from_camera = scene.world_from_camera.rotation_matrix();
  const Vector3d up = known_up(scene).value_or(-world_from_camera.col(1));
  Vector3d away = world_from_camera.col(2) - world_from_camera.col(2).dot(up) * up;
  // Looking straight down or up, away is where the image's upper edge points.
  if (away.norm() < 0.2) away = -world_from_camera.col(1) + world_from_camera.col(1).dot(up) * up;
  away.normalize();
  Matrix3d room_from_world;
  room_from_world.row(0) = away.cross(up);
  room_from_world.row(1) = away;
  room_from_world.row(2) = up;
  return RoomFromWorld(room_from_world);
}

std::optional<AlignedBox3d> scene_bounds(const Scene& scene, const RoomFromWorld& room) {
  std::array<std::vector<double>, 3> coordinates;
  if (scene.surface) {
    for (const SurfaceBlockPtr& block : scene.surface->blocks) {
      if (block->points.empty()) continue;
      const Vector3d p =
          room * block->points[block->points.size() / 2].point_in_world.cast<double>();
      for (int i = 0; i < 3; ++i) coordinates[static_cast<std::size_t>(i)].push_back(p[i]);
    }
  }
  for (const MapPoint& point : scene.points) {
    // What is hardly known may be anywhere.
    if (point.state == FeatureState::candidate || !point.point_in_world.allFinite()) continue;
    const Vector3d p = room * point.point_in_world.cast<double>();
    for (int i = 0; i < 3; ++i) coordinates[static_cast<std::size_t>(i)].push_back(p[i]);
  }
  AlignedBox3d box;
  if (!coordinates[0].empty()) {
    Vector3d low;
    Vector3d high;
    for (int i = 0; i < 3; ++i) {
      std::vector<double>& values = coordinates[static_cast<std::size_t>(i)];
      // Of a few dozen points a wrong one weighs more than of a surface.
      const std::size_t stray = values.size() / (scene.points.empty() ? 100 : 12);
      const auto at = [&values](std::size_t rank) {
        std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank),
                         values.end());
        return values[rank];
      };
      low[i] = at(stray);
      high[i] = at(values.size() - 1 - stray);
    }
    box = AlignedBox3d(low, high);
  }
  if (scene.pose_known) box.extend(room * scene.world_from_camera.translation());
  for (const VirtualObject& object : scene.objects)
    box.extend(room * object.world_from_object.translation());
  if (box.isEmpty()) return std::nullopt;
  // Nothing smaller than a chair fills the view; a few points need some room around them.
  const Vector3d centre = box.center();
  const Vector3d half = (scene.points.empty() ? 0.5 : 0.65) * box.sizes();
  const Vector3d least = half.cwiseMax(0.25);
  return AlignedBox3d(Vector3d(centre - least), Vector3d(centre + least));
}

void Framing::follow(const AlignedBox3d& bounds, double time) {
  const double dt = std::clamp(time - time_, 0.0, 0.5);
  time_ = time;
  if (box_.isEmpty()) {
    box_ = goal_ = bounds;
    return;
  }
  const double slack = 0.08 * goal_.diagonal().norm();
  if ((bounds.min() - goal_.min()).cwiseAbs().maxCoeff() > slack ||
      (bounds.max() - goal_.max()).cwiseAbs().maxCoeff() > slack)
    goal_ = bounds;
  const double step = 1 - std::exp(-dt / 0.4);
  box_.min() += step * (goal_.min() - box_.min());
  box_.max() += step * (goal_.max() - box_.max());
}

View orbit_view(const Orbit& orbit, const Framing& framing, const RoomFromWorld& room, int width,
                int height) {
  const double focal = 0.5 * std::min(width, height) / std::tan(0.5 * kFieldOfView);
  const double radius = 0.5 * framing.box().diagonal().norm();
  // The corners of a box are empty more often than not: closer than its whole ball.
  const double distance = 0.72 * radius / std::sin(0.5 * kFieldOfView) / orbit.zoom;
  const Vector3d forward(std::sin(orbit.azimuth) * std::cos(orbit.elevation),
                         std::cos(orbit.azimuth) * std::cos(orbit.elevation),
                         -std::sin(orbit.elevation));
  const Vector3d centre = framing.box().center() + orbit.pan - distance * forward;
  const Eigen::Quaterniond world_from_room = room.conjugate();
  View view = view_of(pinhole(width, height, focal, focal, 0.5 * (width - 1), 0.5 * (height - 1)),
                      looking(world_from_room * centre, world_from_room * forward,
                              world_from_room * Vector3d::UnitZ()));
  set_depth_range(view, distance, radius);
  return view;
}

View side_view(Side side, const Framing& framing, const RoomFromWorld& room, int width,
               int height) {
  const Vector3d forward = side == Side::top     ? Vector3d(0, 0, -1)
                           : side == Side::front ? Vector3d(0, 1, 0)
                                                 : Vector3d(-1, 0, 0);
  const Vector3d up = side == Side::top ? Vector3d(0, 1, 0) : Vector3d(0, 0, 1);
  const Vector3d right = forward.cross(up);
  const Vector3d sizes = framing.box().sizes();
  const double radius = 0.5 * sizes.norm();
  const double scale = 0.88 * std::min(width / std::abs(sizes.dot(right)),
                                       height / std::abs(sizes.dot(up)));  // px per metre
  const Eigen::Quaterniond world_from_room = room.conjugate();
  View view = view_of(pinhole(width, height, scale, scale, 0.5 * (width - 1), 0.5 * (height - 1)),
                      looking(world_from_room * (framing.box().center() - 2 * radius * forward),
                              world_from_room * forward, world_from_room * up));
  view.orthographic = true;
  set_depth_range(view, 2 * radius, radius);
  return view;
}

Ray ray_through(const View& view, const Eigen::Vector2d& target_pixel) {
  const Eigen::Vector2d pixel = camera_pixel_from_target(view, target_pixel);
  const Pose& pose = view.world_from_camera;
  if (!view.orthographic)
    return {pose.translation(), pose.rotation() * unproject(view.camera, pixel).normalized()};
  const Vector3d start((pixel.x() - view.camera.cx) / view.camera.fx,
                       (pixel.y() - view.camera.cy) / view.camera.fy, 0);
  return {pose * start, pose.rotation() * Vector3d::UnitZ()};
}

}  // namespace armsreach::render
