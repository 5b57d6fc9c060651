#include "vision/gaze/inverse_kinematics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

namespace armsreach {
namespace {

using Eigen::Vector3d;

// Of upright against on target: exact solutions satisfy both, at a limit the target is worth 1e4
// times as much.
constexpr double kTorsionWeight = 0.01;
constexpr double kGood = 1e-5;  // rad

struct Aim {
  const GimbalModel& model;
  Vector3d point;  // in the mount
  Vector3d up;     // in the mount, unit

  // Bearing and elevation of the target off the optical axis, and the torsion, which counts for
  // less the more `up` lies along the axis.
  Vector3d residuals(const Vector3d& angles) const {
    const Pose camera_from_mount = mount_from_camera(model, angles).inverse();
    const Vector3d target = camera_from_mount * point;
    const Vector3d above = camera_from_mount.rotation() * up;
    return {std::atan2(target.x(), target.z()),
            std::atan2(target.y(), std::hypot(target.x(), target.z())),
            std::atan2(above.x(), -above.y()) * std::hypot(above.x(), above.y())};
  }

  Vector3d weighted(const Vector3d& angles) const {
    return residuals(angles).cwiseProduct(Vector3d(1, 1, kTorsionWeight));
  }

  Eigen::Matrix3d jacobian(const Vector3d& angles) const {
    constexpr double kStep = 1e-6;
    Eigen::Matrix3d columns;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d step = kStep * Vector3d::Unit(axis);
      columns.col(axis) = (weighted(angles + step) - weighted(angles - step)) / (2 * kStep);
    }
    return columns;
  }
};

// An axis at its limit that the gradient presses against it takes no part.
void hold_at_limits(const GimbalModel& model, const Vector3d& angles, Eigen::Matrix3d& jacobian,
                    const Vector3d& residuals) {
  const Vector3d downhill = -jacobian.transpose() * residuals;
  for (int axis = 0; axis < 3; ++axis) {
    const bool held = (angles[axis] <= model.lower[axis] && downhill[axis] < 0) ||
                      (angles[axis] >= model.upper[axis] && downhill[axis] > 0);
    if (held) jacobian.col(axis).setZero();
  }
}

// Levenberg-Marquardt inside the box of the limits.
Vector3d descend(const Aim& aim, const Vector3d& start) {
  constexpr int kIterations = 40;
  Vector3d angles = clamped(aim.model, start);
  Vector3d residuals = aim.weighted(angles);
  double damping = 1e-6;
  for (int i = 0; i < kIterations && residuals.norm() > 1e-10; ++i) {
    Eigen::Matrix3d jacobian = aim.jacobian(angles);
    hold_at_limits(aim.model, angles, jacobian, residuals);
    const Eigen::Matrix3d normal =
        jacobian.transpose() * jacobian + damping * Eigen::Matrix3d::Identity();
    const Vector3d next =
        clamped(aim.model, angles - normal.ldlt().solve(jacobian.transpose() * residuals));
    const Vector3d there = aim.weighted(next);
    if (there.norm() < residuals.norm()) {
      angles = next;
      residuals = there;
      damping = std::max(0.1 * damping, 1e-12);
    } else {
      damping *= 10;
    }
  }
  return angles;
}

}  // namespace

GimbalSolution look_at(const GimbalModel& model, const Vector3d& point_in_mount,
                       const Vector3d& up_in_mount, const Vector3d& start) {
  const Aim aim{model, point_in_mount, up_in_mount.normalized()};
  const Vector3d middle = 0.5 * (model.lower + model.upper);
  const Vector3d half = 0.25 * (model.upper - model.lower);
  const std::array<Vector3d, 6> starts{start,
                                       Vector3d::Zero(),
                                       middle + half.cwiseProduct(Vector3d(1, 1, 0)),
                                       middle + half.cwiseProduct(Vector3d(-1, 1, 0)),
                                       middle + half.cwiseProduct(Vector3d(1, -1, 0)),
                                       middle + half.cwiseProduct(Vector3d(-1, -1, 0))};
  Vector3d best = descend(aim, starts[0]);
  for (std::size_t i = 1; i < starts.size() && aim.weighted(best).norm() > kGood; ++i) {
    const Vector3d other = descend(aim, starts[i]);
    if (aim.weighted(other).norm() < aim.weighted(best).norm() - kGood) best = other;
  }
  const Vector3d left = aim.residuals(best);
  const double error = std::acos(std::clamp(std::cos(left[0]) * std::cos(left[1]), -1.0, 1.0));
  return {best, error, left[2]};
}

}  // namespace armsreach
