#include "render/scene_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "render/theme.hpp"

namespace armsreach::render {

using Eigen::Vector3d;
using Eigen::Vector3f;

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

}  // namespace armsreach::render
