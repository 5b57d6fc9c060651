// A three-axis mount between a carrier (a shoulder, a head, a robot) and its camera.
//
// At rest the camera's axes are the mount's: x right, y down, z forward. Pan turns about y, to the
// right when positive; tilt about x, upwards; roll (cyclotorsion) about z, clockwise as the camera
// sees it. Angles are ordered pan, tilt, roll whatever the order of the axes.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

#include <Eigen/Core>

#include "vision/core/pose.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

enum class GimbalAxis { pan, tilt, roll };

struct GimbalModel {
  // From the mount outwards: each axis carries the next one.
  std::array<GimbalAxis, 3> order{GimbalAxis::pan, GimbalAxis::tilt, GimbalAxis::roll};
  Pose mount_from_base;  // to the first axis
  // From each axis to the next, and from the last one to the camera's centre, at rest; m.
  std::array<Eigen::Vector3d, 3> offsets{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                         Eigen::Vector3d::Zero()};
  Eigen::Vector3d lower{-1.57, -1.05, -0.79};  // rad
  Eigen::Vector3d upper{1.57, 1.05, 0.79};     // rad
  Eigen::Vector3d fastest{5.2, 5.2, 5.2};      // rad/s
  Eigen::Vector3d acceleration{60, 60, 60};    // rad/s^2, at most
  double lag = 0.02;                           // s, from a command to the first motion
};

// Where the axes shall go, or are asked to be at a time.
struct GimbalCommand {
  Timestamp time = 0;
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
};

struct GimbalState {
  Timestamp time = 0;
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();  // rad
  Eigen::Vector3d rates = Eigen::Vector3d::Zero();   // rad/s
};

Pose mount_from_camera(const GimbalModel& model, const Eigen::Vector3d& angles);

// before_from_after of the camera when the axes turn and the mount stays: the motion that a filter
// over the camera is told of.
Pose camera_motion(const GimbalModel& model, const Eigen::Vector3d& before,
                   const Eigen::Vector3d& after);

// Within the limits.
Eigen::Vector3d clamped(const GimbalModel& model, const Eigen::Vector3d& angles);

// In a list in order of time: the state at `time`, interpolated between its neighbours.
template <class States>
std::optional<GimbalState> interpolated_state(const States& states, Timestamp time) {
  const auto after =
      std::lower_bound(states.begin(), states.end(), time,
                       [](const GimbalState& state, Timestamp t) { return state.time < t; });
  if (after == states.end()) return std::nullopt;
  if (after->time == time) return *after;
  if (after == states.begin()) return std::nullopt;
  const GimbalState& before = *std::prev(after);
  const double share =
      static_cast<double>(time - before.time) / static_cast<double>(after->time - before.time);
  return GimbalState{time, before.angles + share * (after->angles - before.angles),
                     before.rates + share * (after->rates - before.rates)};
}

}  // namespace armsreach
