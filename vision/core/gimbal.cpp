#include "vision/core/gimbal.hpp"

namespace armsreach {
namespace {

Eigen::Quaterniond turned(GimbalAxis axis, const Eigen::Vector3d& angles) {
  switch (axis) {
    case GimbalAxis::pan:
      return so3_exp(angles[0] * Eigen::Vector3d::UnitY());
    case GimbalAxis::tilt:
      return so3_exp(angles[1] * Eigen::Vector3d::UnitX());
    case GimbalAxis::roll:
      return so3_exp(angles[2] * Eigen::Vector3d::UnitZ());
  }
  return Eigen::Quaterniond::Identity();
}

}  // namespace

Pose mount_from_camera(const GimbalModel& model, const Eigen::Vector3d& angles) {
  Pose pose = model.mount_from_base;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Quaterniond rotation = turned(model.order[i], angles);
    pose = pose * Pose(rotation, rotation * model.offsets[i]);
  }
  return pose;
}

Pose camera_motion(const GimbalModel& model, const Eigen::Vector3d& before,
                   const Eigen::Vector3d& after) {
  return mount_from_camera(model, before).inverse() * mount_from_camera(model, after);
}

Eigen::Vector3d clamped(const GimbalModel& model, const Eigen::Vector3d& angles) {
  return angles.cwiseMax(model.lower).cwiseMin(model.upper);
}

}  // namespace armsreach
