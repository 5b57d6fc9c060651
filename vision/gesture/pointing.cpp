#include "vision/gesture/pointing.hpp"

#include <cmath>

namespace armsreach::gesture {

Eigen::Vector2d Wedge::axis() const { return {std::sin(angle), -std::cos(angle)}; }

std::optional<std::size_t> under_cursor(const Eigen::Vector2d& cursor, double reach,
                                        const std::vector<Pointable>& things) {
  std::optional<std::size_t> found;
  double nearest = reach;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const double distance = (things[i].center - cursor).norm() - things[i].radius;
    if (distance > nearest) continue;
    nearest = distance;
    found = i;
  }
  return found;
}

std::optional<std::size_t> in_wedge(const Wedge& wedge, const std::vector<Pointable>& things) {
  std::optional<std::size_t> found;
  double nearest = 0;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const Eigen::Vector2d offset = things[i].center - wedge.origin;
    const double distance = offset.norm();
    if (distance <= things[i].radius) continue;
    const Eigen::Vector2d axis = wedge.axis();
    const double across = axis.x() * offset.y() - axis.y() * offset.x();
    const double angle = std::abs(std::atan2(across, axis.dot(offset)));
    if (angle > wedge.half_angle + std::asin(things[i].radius / distance)) continue;
    if (found && distance >= nearest) continue;
    nearest = distance;
    found = i;
  }
  return found;
}

}  // namespace armsreach::gesture
