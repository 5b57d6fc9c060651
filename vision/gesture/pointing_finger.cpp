#include "vision/gesture/pointing_finger.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace armsreach::gesture {
namespace {

// In square roots of the hand's area: the finger is what lies this near its tip, and its middle
// line runs there; nearer, the round end says little, and farther on the knuckles begin.
constexpr double kLength = 0.5;

Eigen::Vector2d direction(double angle) { return {std::sin(angle), -std::cos(angle)}; }

template <class Use>
void for_each_pixel(const HandShape& shape, Use use) {
  for (int row = 0; row < shape.mask.rows; ++row) {
    const auto* pixels = shape.mask.ptr<std::uint8_t>(row);
    for (int col = 0; col < shape.mask.cols; ++col) {
      if (pixels[col] != 0)
        use(Eigen::Vector2d(shape.mask_origin + shape.mask_scale * Eigen::Vector2d(col, row)));
    }
  }
}

Eigen::Vector2d farthest_along(const HandShape& shape, const Eigen::Vector2d& axis) {
  Eigen::Vector2d tip = shape.center;
  double farthest = std::numeric_limits<double>::lowest();
  for_each_pixel(shape, [&](const Eigen::Vector2d& at) {
    if (at.dot(axis) <= farthest) return;
    farthest = at.dot(axis);
    tip = at;
  });
  return tip;
}

// From the finger's farther half to its nearer one: the means of their pixels lie on its middle
// line, wherever on the round end the tip was found.
Eigen::Vector2d axis_at(const HandShape& shape, const Eigen::Vector2d& tip) {
  const double length = kLength * std::sqrt(shape.area);
  Eigen::Vector3d near(0, 0, 0);  // sums of x, y and 1
  Eigen::Vector3d far(0, 0, 0);
  for_each_pixel(shape, [&](const Eigen::Vector2d& at) {
    const double distance = (at - tip).norm();
    if (distance > length) return;
    (distance < length / 2 ? near : far) += at.homogeneous();
  });
  if (near.z() == 0 || far.z() == 0) return {0, 0};
  return near.hnormalized() - far.hnormalized();
}

}  // namespace

PointingFinger pointing_finger(const HandShape& shape, double angle) {
  constexpr int kTurns = 3;  // the tip and the axis settle on each other
  PointingFinger finger{shape.center, angle};
  for (int i = 0; i < kTurns; ++i) {
    finger.tip = farthest_along(shape, direction(finger.angle));
    const Eigen::Vector2d axis = axis_at(shape, finger.tip);
    if (axis.norm() == 0) break;
    finger.angle = std::atan2(axis.x(), -axis.y());
  }
  return finger;
}

}  // namespace armsreach::gesture
