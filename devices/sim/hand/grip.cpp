#include "devices/sim/hand/grip.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include <Eigen/Geometry>

#include "devices/sim/hand/contact.hpp"
#include "devices/sim/hand/skeleton.hpp"

namespace armsreach::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kPalmThickness = 0.0125;  // m, from the palm's bones to its skin
constexpr double kOblique = 12 * kDegree;  // a handle runs from the index's middle to the wrist's
                                           // little-finger side
constexpr double kClosed = 0.024;          // m of diameter, below which the hand is a fist
constexpr double kWrapped = 0.05;  // m of diameter, below which fingertips come under the thumb

struct Handle {
  Pose handle_from_hand;
  double radius;
};

// From the flesh around a bone to the handle's surface; negative inside.
double gap(const HandAnatomy& anatomy, const HandPose& pose, Finger finger, int part,
           const Handle& handle) {
  const HandSkeleton skeleton = skeleton_of(anatomy, pose);
  const bool thumb = finger == Finger::thumb;
  const std::size_t i = static_cast<std::size_t>(thumb ? part : part - 1);
  const FingerAnatomy& other = anatomy.fingers[thumb ? 0 : static_cast<std::size_t>(finger) - 1];
  const double length = thumb ? anatomy.thumb.lengths[i] : other.lengths[i];
  const auto& radii = thumb ? anatomy.thumb.radii : other.radii;
  double nearest = 1;
  for (const double along : {0.4, 0.6, 0.8, 1.0}) {
    // The fingertip's ball ends at the bone's end.
    const bool tip = part == (thumb ? 2 : 3);
    const double radius = radii[i] + along * (radii[i + 1] - radii[i]);
    const Eigen::Vector3d point(0, tip ? along * (length - radius) : along * length, 0);
    const Eigen::Vector3d p = handle.handle_from_hand * (skeleton[joint_of(finger, part)] * point);
    nearest = std::min(nearest, p.tail<2>().norm() - radius - handle.radius);
  }
  return nearest;
}

// Turns one joint from `open` towards `closed` until its bone touches.
void close(const HandAnatomy& anatomy, Finger finger, int part, const Handle& handle,
           Eigen::Index angle, double open, double closed, HandPose& pose) {
  constexpr int kSteps = 60;
  for (int step = 0; step <= kSteps; ++step) {
    pose[angle] = open + (closed - open) * step / kSteps;
    if (gap(anatomy, pose, finger, part, handle) <= 0) return;
  }
}

}  // namespace

Pose hand_from_handle(const HandAnatomy& anatomy, double diameter) {
  const Eigen::Vector3d knuckle = anatomy.fingers[1].knuckle;
  const Eigen::Vector3d centre(knuckle.x(), 0.84 * knuckle.y(),
                               kPalmThickness * anatomy.flesh + 0.5 * diameter);
  return {Eigen::Quaterniond(Eigen::AngleAxisd(kOblique, Eigen::Vector3d::UnitZ())), centre};
}

HandPose pose_around(const HandAnatomy& anatomy, double diameter) {
  const Handle handle{hand_from_handle(anatomy, diameter).inverse(), 0.5 * diameter};
  HandPose pose = HandPose::Zero();
  constexpr std::array kSpread{3.0, 0.0, -3.0, -7.0};
  for (const Finger finger : kFingers) {
    pose[angle_index(finger, FingerAngle::spread)] =
        kSpread[static_cast<std::size_t>(finger) - 1] * kDegree;
    close(anatomy, finger, 1, handle, angle_index(finger, FingerAngle::mcp), 0, 85 * kDegree, pose);
    close(anatomy, finger, 2, handle, angle_index(finger, FingerAngle::pip), 0, 110 * kDegree,
          pose);
    close(anatomy, finger, 3, handle, angle_index(finger, FingerAngle::dip), 0, 75 * kDegree, pose);
  }
  pose[thumb_twist] = 5 * kDegree;
  if (diameter < kClosed) {
    pose[thumb_radial] = 30 * kDegree;
    pose[thumb_palmar] = pose[thumb_mcp] = pose[thumb_ip] = 42 * kDegree;
    const std::array contact{
        Contact{{Finger::thumb, 2, 0.6, {0, 0, 1}}, {Finger::index, 2, 0.8, {0, 0, -1}}}};
    return touching(anatomy, pose, contact);
  }
  // Around a handle that is not thick the thumb lies over the fingers.
  Handle under_thumb = handle;
  if (diameter < kWrapped) under_thumb.radius += 1.6 * anatomy.fingers[0].radii[2];
  // It opens wider for what is thicker than the web between thumb and index finger is deep.
  pose[thumb_radial] = (38 + 700 * std::clamp(diameter - 0.05, 0.0, 0.035)) * kDegree;
  close(anatomy, Finger::thumb, 1, under_thumb, thumb_palmar, 75 * kDegree, 25 * kDegree, pose);
  close(anatomy, Finger::thumb, 1, under_thumb, thumb_mcp, 0, 45 * kDegree, pose);
  close(anatomy, Finger::thumb, 2, under_thumb, thumb_ip, 0, 60 * kDegree, pose);
  return within_limits(pose);
}

}  // namespace armsreach::sim
