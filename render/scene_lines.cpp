#include "render/scene_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "render/theme.hpp"

namespace armsreach::render {

using Eigen::Vector3d;
using Eigen::Vector3f;

namespace {

constexpr float kSmallest = 0.004F;  // m, of an ellipsoid's half axes
constexpr float kLargest = 0.6F;
constexpr float kCross = 0.012F;  // m
constexpr theme::Color kBlue{104, 160, 246, 255};

theme::Color faded(theme::Color color, float share) {
  color[3] = static_cast<std::uint8_t>(255 * std::clamp(share, 0.F, 1.F));
  return color;
}

void add_cross(Lines& lines, const Vector3f& at, float size, const theme::Color& color) {
  for (int i = 0; i < 3; ++i) {
    const Vector3f arm = 0.5F * size * Vector3f::Unit(i);
    lines.segment(at - arm, at + arm, color);
  }
}

// Three ellipses, each in a plane of two of the axes.
void add_ellipsoid(Lines& lines, const MapPoint& point) {
  constexpr int kSegments = 20;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(point.covariance);
  const Vector3f half =
      (3 * axes.eigenvalues().cwiseMax(0.F).cwiseSqrt()).cwiseMax(kSmallest).cwiseMin(kLargest);
  // What is hardly known is large, and must not hide what is.
  const theme::Color color = faded(color_of(point.state), 0.06F / (0.05F + half.maxCoeff()));
  for (int plane = 0; plane < 3; ++plane) {
    const Vector3f u = half[plane] * axes.eigenvectors().col(plane);
    const Vector3f v = half[(plane + 1) % 3] * axes.eigenvectors().col((plane + 1) % 3);
    Vector3f last = point.point_in_world + u;
    for (int i = 1; i <= kSegments; ++i) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kSegments;
      const Vector3f next = point.point_in_world + std::cos(angle) * u + std::sin(angle) * v;
      lines.segment(last, next, color);
      last = next;
    }
  }
}

}  // namespace

theme::Color color_of(FeatureState state) {
  switch (state) {
    case FeatureState::candidate:
      return theme::kWarning;
    case FeatureState::tracked:
      return theme::kAccent;
    case FeatureState::failed:
      return theme::kBad;
  }
  return theme::kInk;
}

double round_length(double limit) {
  const double decade = std::pow(10, std::floor(std::log10(limit)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= limit) return factor * decade;
  }
  return decade;
}

void add_ground(Lines& lines, const Eigen::AlignedBox3d& box, const RoomFromWorld& room) {
  const double radius = 0.5 * box.sizes().head<2>().norm();
  const double cell = round_length(std::max(0.1, 0.45 * radius));
  const int reach = std::clamp(static_cast<int>(std::ceil(1.4 * radius / cell)), 2, 8);
  const Vector3d centre(std::round(box.center().x() / cell) * cell,
                        std::round(box.center().y() / cell) * cell, box.min().z());
  const auto world = [&](double x, double y) {
    return Vector3f((room.conjugate() * (centre + Vector3d(x, y, 0))).cast<float>());
  };
  for (int i = -reach; i <= reach; ++i) {
    theme::Color color = theme::kLine;
    const double fade = 1 - std::abs(i) / (reach + 1.0);
    color[3] = static_cast<std::uint8_t>(190 * fade);
    lines.segment(world(i * cell, -reach * cell), world(i * cell, reach * cell), color);
    lines.segment(world(-reach * cell, i * cell), world(reach * cell, i * cell), color);
  }
}

void add_camera(Lines& lines, const Scene& scene, double size) {
  const Camera& camera = scene.camera;
  if (camera.width <= 0) return;
  const auto at = [&](double x, double y) {
    return Vector3f((scene.world_from_camera * (size * unproject(camera, {x, y}))).cast<float>());
  };
  const double right = camera.width - 0.5;
  const double low = camera.height - 0.5;
  const std::array corners{at(-0.5, -0.5), at(right, -0.5), at(right, low), at(-0.5, low)};
  const Vector3f centre = scene.world_from_camera.translation().cast<float>();
  for (std::size_t i = 0; i < 4; ++i) {
    lines.segment(centre, corners[i], theme::kAccent);
    lines.segment(corners[i], corners[(i + 1) % 4], theme::kAccent);
  }
}

void add_trails(Lines& lines, const Scene& scene) {
  for (const Trail& trail : scene.trails) {
    const Vector3f rgb = 255 * trail.color.cwiseMax(0.F).cwiseMin(1.F);
    lines.fading_path(trail.points_in_world,
                      {static_cast<std::uint8_t>(rgb.x()), static_cast<std::uint8_t>(rgb.y()),
                       static_cast<std::uint8_t>(rgb.z()), 255});
  }
}

void add_points(Lines& lines, const Scene& scene, PointDetail detail) {
  for (const MapPoint& point : scene.points) {
    if (!point.point_in_world.allFinite() || !point.covariance.allFinite()) continue;
    add_cross(lines, point.point_in_world, kCross, color_of(point.state));
    if (detail == PointDetail::ellipsoids) add_ellipsoid(lines, point);
  }
  for (const Particle& particle : scene.particles) {
    if (particle.point_in_world.allFinite())
      add_cross(lines, particle.point_in_world, 0.5F * kCross,
                faded(theme::kWarning, particle.weight));
  }
}

void add_world_axes(Lines& lines, double size) {
  const std::array colors{theme::kBad, theme::kGood, kBlue};
  for (int i = 0; i < 3; ++i) {
    lines.segment(Vector3f::Zero(), static_cast<float>(size) * Vector3f::Unit(i),
                  colors[static_cast<std::size_t>(i)]);
  }
}

}  // namespace armsreach::render
