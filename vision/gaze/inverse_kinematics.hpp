// The angles at which a gimbal's camera looks at a point, upright.
#pragma once

#include <Eigen/Core>

#include "vision/core/gimbal.hpp"

namespace armsreach {

struct GimbalSolution {
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();  // within the limits
  double error = 0;                                  // rad, between the optical axis and the target
  double torsion = 0;                                // rad, by which the camera is not upright
  bool reachable() const { return error < 1e-3; }
};

// For any order of the axes and any offsets. Of angles that look equally well at the target those
// with the image's y axis along -up are taken; where the limits forbid to do both, the target goes
// first, and where they forbid that too, the nearest direction that they allow. The search begins
// at `start`, so that the solution stays on the same branch while a target moves.
GimbalSolution look_at(const GimbalModel& model, const Eigen::Vector3d& point_in_mount,
                       const Eigen::Vector3d& up_in_mount, const Eigen::Vector3d& start);

}  // namespace armsreach
