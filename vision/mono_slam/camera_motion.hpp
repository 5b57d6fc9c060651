// The moving camera of the filter: its state and how that changes from frame to frame.
//
// The state has 14 numbers, the covariance 13 rows: an error of the rotation is a small turn about
// the camera's own axes, world_from_camera = estimate * Exp(turn), so that a quaternion's length is
// no direction of the covariance and nothing has to be normalised.
//
// A rolling shutter reads a picture's lines one after the other: what a turning camera sees is
// sheared by several pixels. How long that takes is part of the state, since no calibration file
// says it; the pose is that of the middle line.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "vision/core/pose.hpp"

namespace armsreach::mono_slam {

struct CameraState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();            // in the world, m
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // world_from_camera
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();            // in the world, m/s
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();    // about the camera's axes, rad/s
  double readout = 0;  // s from the first line to the last; 0 of a global shutter

  Pose world_from_camera() const { return Pose(rotation, position); }
};

// Rows of the covariance: position, turn, velocity, angular velocity, readout.
inline constexpr int kCameraRows = 13;
inline constexpr int kPoseRows = 6;  // the first of them
inline constexpr int kReadoutRow = 12;
using CameraCovariance = Eigen::Matrix<double, kCameraRows, kCameraRows>;
using CameraError = Eigen::Matrix<double, kCameraRows, 1>;

CameraState corrected(const CameraState& state, const CameraError& error);
// The error that `corrected` would add to `from` to make it `to`.
CameraError difference(const CameraState& to, const CameraState& from);

// Between two frames the velocities jump by white impulses: acceleration times the interval.
// Source: Davison, Reid, Molton, Stasse, "MonoSLAM", PAMI 2007, section 3.4.
struct MotionNoise {
  double acceleration = 4;          // m/s^2, one deviation of each axis
  double angular_acceleration = 6;  // rad/s^2
  // m / sqrt(s): what is recognised as a point slides over its surface as the view changes, so that
  // a map is never known better than it is recognised.
  double point_wander = 1e-3;
};

// A motion that was commanded, on top of what the carrier does by itself: the camera's new pose in
// its old frame as the gimbal alone would make it.
struct CameraControl {
  Pose before_from_after;
  double translation_sigma = 0;  // m, how far the mount departs from its command
  double rotation_sigma = 0;     // rad
};

// The state after `seconds`: constant velocities, then the control. `by_state`, when given,
// receives the Jacobian of its error by the old one's. Impulses enter like errors of the
// velocities.
CameraState moved(const CameraState& state, double seconds,
                  const std::optional<CameraControl>& control,
                  CameraCovariance* by_state = nullptr);

}  // namespace armsreach::mono_slam
