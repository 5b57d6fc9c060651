// The posture of a hand as joint angles, without the lengths of anybody's bones.
#pragma once

#include <array>

#include <Eigen/Core>

namespace armsreach::sim {

enum class Finger { thumb, index, middle, ring, little };
inline constexpr std::array kFingers{Finger::index, Finger::middle, Finger::ring, Finger::little};

// How a finger other than the thumb bends. `spread` is positive towards the thumb's side; the
// others are flexions, positive towards the palm.
enum class FingerAngle { spread, mcp, pip, dip };

// Radians. The thumb's metacarpal points `thumb_radial` away from the direction of the fingers,
// within the palm's plane, and `thumb_palmar` out of it; `thumb_twist` turns its pad from facing
// the index finger towards where the palm faces. `cup` lifts the palm's little-finger side;
// `wrist_flexion` bends the hand towards the palm and `wrist_deviation` towards the thumb.
enum HandAngle : Eigen::Index {
  thumb_radial,
  thumb_palmar,
  thumb_twist,
  thumb_mcp,
  thumb_ip,
  first_finger_angle,
  cup = first_finger_angle + 16,
  wrist_flexion,
  wrist_deviation,
  hand_angle_count
};
using HandPose = Eigen::Matrix<double, hand_angle_count, 1>;

inline Eigen::Index angle_index(Finger finger, FingerAngle angle) {
  return first_finger_angle + 4 * (static_cast<Eigen::Index>(finger) - 1) +
         static_cast<Eigen::Index>(angle);
}

// The range of motion of healthy adults. Source: Norkin, White, "Measurement of Joint Motion: A
// Guide to Goniometry", 2009, widened where a surface's contact pushes a joint beyond what its
// muscles do.
struct HandLimits {
  HandPose low;
  HandPose high;
};
const HandLimits& hand_limits();
HandPose within_limits(const HandPose& pose);

// Every angle on its straight way from a (at 0) to b (at 1).
HandPose blend(const HandPose& a, const HandPose& b, double fraction);

}  // namespace armsreach::sim
