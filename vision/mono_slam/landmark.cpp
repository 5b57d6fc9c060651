#include "vision/mono_slam/landmark.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::mono_slam {

bool recognisable(const Landmark& landmark, const Eigen::Vector3d& point_in_world,
                  const Pose& world_from_camera, const LandmarkRules& rules) {
  const Eigen::Vector3d first = landmark.patch.world_from_camera.translation() - point_in_world;
  const Eigen::Vector3d now = world_from_camera.translation() - point_in_world;
  const double ratio = now.norm() / std::max(first.norm(), 1e-6);
  if (ratio > rules.most_range_ratio || ratio < 1 / rules.most_range_ratio) return false;
  return first.dot(now) > std::cos(rules.most_turn) * first.norm() * now.norm();
}

bool well_inside(const Camera& camera, const Eigen::Vector2d& pixel, const LandmarkRules& rules) {
  return pixel.x() >= rules.border && pixel.y() >= rules.border &&
         pixel.x() <= camera.width - 1 - rules.border &&
         pixel.y() <= camera.height - 1 - rules.border;
}

bool failed(const Landmark& landmark, const LandmarkRules& rules) {
  return landmark.attempts >= rules.least_attempts &&
         landmark.successes < rules.least_success * landmark.attempts;
}

}  // namespace armsreach::mono_slam
