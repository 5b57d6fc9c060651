#include "vision/core/pose.hpp"

#include <cmath>

namespace armsreach {
namespace {

// Below this angle the closed forms lose digits and the Taylor series is exact to double precision.
constexpr double kSmallAngle = 1e-4;

// V(phi) with exp((rho, phi)).translation = V(phi) rho.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& phi) {
  const double angle2 = phi.squaredNorm();
  const double angle = std::sqrt(angle2);
  const Eigen::Matrix3d k = skew(phi);
  double a = 0;  // (1 - cos) / angle^2
  double b = 0;  // (angle - sin) / angle^3
  if (angle < kSmallAngle) {
    a = 0.5 - angle2 / 24;
    b = 1.0 / 6 - angle2 / 120;
  } else {
    const double half_sine = std::sin(angle / 2);
    a = 2 * half_sine * half_sine / angle2;
    b = (angle - std::sin(angle)) / (angle2 * angle);
  }
  return Eigen::Matrix3d::Identity() + a * k + b * k * k;
}

Eigen::Matrix3d left_jacobian_inverse(const Eigen::Vector3d& phi) {
  const double angle2 = phi.squaredNorm();
  const double angle = std::sqrt(angle2);
  const Eigen::Matrix3d k = skew(phi);
  double c = 0;  // 1/angle^2 - (1 + cos) / (2 angle sin)
  if (angle < 1e-2) {
    c = 1.0 / 12 + angle2 / 720 + angle2 * angle2 / 30240;
  } else {
    const double half = angle / 2;
    c = (1 - half * std::cos(half) / std::sin(half)) / angle2;
  }
  return Eigen::Matrix3d::Identity() - 0.5 * k + c * k * k;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Quaterniond so3_exp(const Eigen::Vector3d& phi) {
  const double angle = phi.norm();
  const double scale = angle < kSmallAngle ? 0.5 - angle * angle / 48 : std::sin(angle / 2) / angle;
  Eigen::Quaterniond q(std::cos(angle / 2), scale * phi.x(), scale * phi.y(), scale * phi.z());
  return q.normalized();
}

Eigen::Vector3d so3_log(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0 ? -1 : 1;  // q and -q are one rotation: take the short way
  const Eigen::Vector3d v = sign * rotation.vec();
  const double sine = v.norm();
  const double cosine = sign * rotation.w();
  if (sine < kSmallAngle) return (2 / cosine) * (1 - sine * sine / (3 * cosine * cosine)) * v;
  return (2 * std::atan2(sine, cosine) / sine) * v;
}

Pose Pose::from_matrix(const Eigen::Matrix4d& matrix) {
  return {Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())),
          matrix.topRightCorner<3, 1>()};
}

Pose Pose::exp(const Vector6d& tangent) {
  const Eigen::Vector3d phi = tangent.tail<3>();
  return {so3_exp(phi), left_jacobian(phi) * tangent.head<3>()};
}

Vector6d Pose::log() const {
  const Eigen::Vector3d phi = so3_log(rotation_);
  Vector6d tangent;
  tangent << left_jacobian_inverse(phi) * translation_, phi;
  return tangent;
}

Eigen::Matrix4d Pose::matrix() const {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = rotation_matrix();
  m.topRightCorner<3, 1>() = translation_;
  return m;
}

Pose Pose::inverse() const {
  const Eigen::Quaterniond inverse_rotation = rotation_.conjugate();
  return {inverse_rotation, -(inverse_rotation * translation_)};
}

Pose Pose::operator*(const Pose& other) const {
  return {rotation_ * other.rotation_, rotation_ * other.translation_ + translation_};
}

Matrix6d Pose::adjoint() const {
  const Eigen::Matrix3d r = rotation_matrix();
  Matrix6d m = Matrix6d::Zero();
  m.topLeftCorner<3, 3>() = r;
  m.topRightCorner<3, 3>() = skew(translation_) * r;
  m.bottomRightCorner<3, 3>() = r;
  return m;
}

bool Pose::is_finite() const { return rotation_.coeffs().allFinite() && translation_.allFinite(); }

Pose interpolate(const Pose& a, const Pose& b, double fraction) {
  return a * Pose::exp(fraction * (a.inverse() * b).log());
}

}  // namespace armsreach
