// The finger of a hand that points: its tip and its axis, from the hand's shape alone.
#pragma once

#include <Eigen/Core>

#include "vision/gesture/hand_shape.hpp"

namespace armsreach::gesture {

struct PointingFinger {
  Eigen::Vector2d tip{0, 0};  // px of the image
  double angle = 0;           // rad of the way it points, 0 upwards, clockwise positive
};

// `angle`: about where it points, from the gesture's template.
PointingFinger pointing_finger(const HandShape& shape, double angle);

}  // namespace armsreach::gesture
