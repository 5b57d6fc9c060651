#include "vision/mono_slam/camera_motion.hpp"

#include <cmath>

namespace armsreach::mono_slam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Exp(v + dv) = Exp(v) Exp(J dv); Sola, Deray, Atchuthan 2018, eq. 143.
Matrix3d right_jacobian(const Vector3d& v) {
  const double angle2 = v.squaredNorm();
  const Matrix3d s = skew(v);
  if (angle2 < 1e-10) return Matrix3d::Identity() - 0.5 * s + s * s / 6;
  const double angle = std::sqrt(angle2);
  return Matrix3d::Identity() - (1 - std::cos(angle)) / angle2 * s +
         (angle - std::sin(angle)) / (angle2 * angle) * s * s;
}

}  // namespace

CameraState corrected(const CameraState& state, const CameraError& error) {
  CameraState out = state;
  out.position += error.segment<3>(0);
  out.rotation = (state.rotation * so3_exp(error.segment<3>(3))).normalized();
  out.velocity += error.segment<3>(6);
  out.angular_velocity += error.segment<3>(9);
  out.readout += error[kReadoutRow];
  return out;
}

CameraError difference(const CameraState& to, const CameraState& from) {
  CameraError out;
  out << to.position - from.position, so3_log(from.rotation.conjugate() * to.rotation),
      to.velocity - from.velocity, to.angular_velocity - from.angular_velocity,
      to.readout - from.readout;
  return out;
}

CameraState moved(const CameraState& state, double seconds,
                  const std::optional<CameraControl>& control, CameraCovariance* by_state) {
  const Vector3d turn = state.angular_velocity * seconds;
  const Eigen::Quaterniond turned = state.rotation * so3_exp(turn);
  const Pose command = control ? control->before_from_after : Pose();
  const Matrix3d after_from_before = command.rotation_matrix().transpose();

  CameraState out;
  out.position = state.position + seconds * state.velocity + turned * command.translation();
  out.rotation = (turned * command.rotation()).normalized();
  out.velocity = state.velocity;
  out.angular_velocity = after_from_before * state.angular_velocity;
  out.readout = state.readout;
  if (by_state) {
    const Matrix3d turn_by_rotation = so3_exp(-turn).toRotationMatrix();
    const Matrix3d turn_by_rate = right_jacobian(turn) * seconds;
    const Matrix3d position_by_turn = -turned.toRotationMatrix() * skew(command.translation());
    by_state->setIdentity();
    by_state->block<3, 3>(0, 3) = position_by_turn * turn_by_rotation;
    by_state->block<3, 3>(0, 6) = seconds * Matrix3d::Identity();
    by_state->block<3, 3>(0, 9) = position_by_turn * turn_by_rate;
    by_state->block<3, 3>(3, 3) = after_from_before * turn_by_rotation;
    by_state->block<3, 3>(3, 9) = after_from_before * turn_by_rate;
    by_state->block<3, 3>(9, 9) = after_from_before;
  }
  return out;
}

}  // namespace armsreach::mono_slam
