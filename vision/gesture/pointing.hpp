// What a hand points at in the image: the thing under its cursor, or the nearest one in the wedge
// that a grasping hand opens along its axis.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace armsreach::gesture {

// A round thing in the image.
struct Pointable {
  Eigen::Vector2d center{0, 0};  // px
  double radius = 0;             // px
};

struct Wedge {
  Eigen::Vector2d origin{0, 0};  // px
  double angle = 0;              // rad of its axis, 0 up, clockwise
  double half_angle = 0.26;      // rad; 15 deg is what a grasp's axis can be trusted to

  Eigen::Vector2d axis() const;  // unit, px
};

// The nearest thing whose edge is within `reach` [px] of the cursor.
std::optional<std::size_t> under_cursor(const Eigen::Vector2d& cursor, double reach,
                                        const std::vector<Pointable>& things);

// The nearest thing that reaches into the wedge. Things around the origin are the hand itself or
// held by it, and not pointed at.
std::optional<std::size_t> in_wedge(const Wedge& wedge, const std::vector<Pointable>& things);

}  // namespace armsreach::gesture
