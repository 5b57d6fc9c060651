// A point of the map beside its place in the filter: its looks, its record, and when it is worth
// looking for.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vision/mono_slam/depth_particles.hpp"
#include "vision/mono_slam/filter.hpp"
#include "vision/mono_slam/patch.hpp"

namespace armsreach::mono_slam {

struct Landmark {
  PointId id = 0;
  Patch patch;
  Template latest;    // as it was last found
  int attempts = 0;   // frames in which it was looked for
  int successes = 0;  // and found where the others agree
  bool of_target = false;
  std::optional<DepthParticles> particles;  // while its distance along the ray is guessed
};

// Davison and others, PAMI 2007, section 3.7.
struct LandmarkRules {
  double most_turn = 0.785;     // rad between the first view and this one
  double most_range_ratio = 2;  // of the distances
  int border = 9;               // px from the image's edge
  int least_attempts = 10;      // before it may be given up
  double least_success = 0.5;
};

// Whether its patch should be recognisable from here, at a place in the world.
bool recognisable(const Landmark& landmark, const Eigen::Vector3d& point_in_world,
                  const Pose& world_from_camera, const LandmarkRules& rules);
bool well_inside(const Camera& camera, const Eigen::Vector2d& pixel, const LandmarkRules& rules);
bool failed(const Landmark& landmark, const LandmarkRules& rules);

}  // namespace armsreach::mono_slam
