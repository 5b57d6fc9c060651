// What a ray meets in a simulated world, found from the world's data alone: the check on depth and
// pose shares nothing with the drawing that it checks.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/world.hpp"

namespace armsreach::sim {

struct Hit {
  double distance = 0;  // in lengths of the ray's direction
  int thing = -1;
  int part = -1;
  bool exact = true;  // false: within a cylinder around a turned shape, which it may yet miss
};

// With the things at these poses.
std::optional<Hit> cast_ray(const World& world, const std::vector<Pose>& world_from_thing,
                            const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

// From a point to the nearest part's bounding box or cylinder; 0 inside.
double clearance(const World& world, const std::vector<Pose>& world_from_thing,
                 const Eigen::Vector3d& point);

}  // namespace armsreach::sim
