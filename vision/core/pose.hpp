// Rigid transforms SE(3), named by frames: world_from_camera maps points in the camera's frame to
// the world's, and world_from_camera * camera_from_hand is world_from_hand.
//
// Tangent vectors are (translation [m], rotation [rad]) in that order, and exp/log are the group's
// own: exp((rho, phi)) = (Exp(phi), V(phi) rho). Source: Sola, Deray, Atchuthan, "A micro Lie
// theory for state estimation in robotics", 2018, eqs. 172-179.
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace armsreach {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

Eigen::Matrix3d skew(const Eigen::Vector3d& v);
Eigen::Quaterniond so3_exp(const Eigen::Vector3d& phi);
Eigen::Vector3d so3_log(const Eigen::Quaterniond& rotation);  // angle in [0, pi]

class Pose {
 public:
  Pose() = default;  // identity
  // `rotation` is normalised here, unless it is a unit already: what was written and is read again
  // stays the same to the bit.
  Pose(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation)
      : rotation_(is_unit(rotation) ? rotation : rotation.normalized()),
        translation_(translation) {}
  static Pose from_matrix(const Eigen::Matrix4d& matrix);

  static Pose exp(const Vector6d& tangent);
  Vector6d log() const;

  const Eigen::Quaterniond& rotation() const { return rotation_; }
  const Eigen::Vector3d& translation() const { return translation_; }
  Eigen::Matrix3d rotation_matrix() const { return rotation_.toRotationMatrix(); }
  Eigen::Matrix4d matrix() const;

  Pose inverse() const;
  Pose operator*(const Pose& other) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation_ * point + translation_;
  }

  // adjoint() * t is the tangent on the left that moves as t does on the right:
  // P * exp(t) == exp(P.adjoint() * t) * P.
  Matrix6d adjoint() const;

  bool is_finite() const;

 private:
  static bool is_unit(const Eigen::Quaterniond& q) {
    return std::abs(q.squaredNorm() - 1) < 1e-15;  // as near as normalising comes
  }

  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation_ = Eigen::Vector3d::Zero();
};

// On the geodesic from a (at fraction 0) to b (at fraction 1).
Pose interpolate(const Pose& a, const Pose& b, double fraction);

}  // namespace armsreach
