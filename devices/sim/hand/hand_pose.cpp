#include "devices/sim/hand/hand_pose.hpp"

#include <numbers>

namespace armsreach::sim {
namespace {

HandLimits make_limits() {
  HandLimits limits;
  const auto set = [&limits](Eigen::Index angle, double low, double high) {
    limits.low[angle] = low * std::numbers::pi / 180;
    limits.high[angle] = high * std::numbers::pi / 180;
  };
  set(thumb_radial, -10, 75);
  set(thumb_palmar, -10, 75);
  set(thumb_twist, -45, 75);
  set(thumb_mcp, -15, 75);
  set(thumb_ip, -25, 85);
  for (const Finger finger : kFingers) {
    set(angle_index(finger, FingerAngle::spread), -30, 25);
    set(angle_index(finger, FingerAngle::mcp), -30, 95);
    set(angle_index(finger, FingerAngle::pip), -5, 115);
    set(angle_index(finger, FingerAngle::dip), -15, 85);
  }
  set(cup, 0, 25);
  set(wrist_flexion, -75, 80);
  set(wrist_deviation, -35, 25);
  return limits;
}

}  // namespace

const HandLimits& hand_limits() {
  static const HandLimits limits = make_limits();
  return limits;
}

HandPose within_limits(const HandPose& pose) {
  return pose.cwiseMax(hand_limits().low).cwiseMin(hand_limits().high);
}

HandPose blend(const HandPose& a, const HandPose& b, double fraction) {
  return a + fraction * (b - a);
}

}  // namespace armsreach::sim
