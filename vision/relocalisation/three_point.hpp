// The pose of a camera from points of the world it sees, among them many it does not see.
//
// Three-point poses in a RANSAC (Fischler, Bolles 1981), refined over all points that agree. Where
// the camera measured depth, that must agree too: triples whose sides have other lengths here than
// in the world are dropped before a pose is computed for them, so thousands can be tried.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vision/core/pose.hpp"

namespace armsreach::relocalisation {

struct Sighting {
  Eigen::Vector3d point_in_world;
  Eigen::Vector2d ray;  // (x, y) of (x, y, 1) in the camera's frame
  double depth;         // m along z; NaN unknown
};

struct ThreePointOptions {
  double ray_tolerance = 0.01;  // of a ray's x and y: pixels by focal length
  int most_samples = 2000;      // triples drawn
  int most_poses = 150;         // triples for which poses are computed
  std::uint64_t seed = 1;
};

struct ThreePointFit {
  Pose camera_from_world;
  std::vector<int> inliers;  // indices of the sightings that agree
};

// What measured and predicted depth may differ by [m]: noise of a structured-light camera (which
// grows with depth squared), of the mapped point, and edges that were met a pixel away.
double depth_tolerance(double depth);

// Nothing when no pose has at least four inliers.
std::optional<ThreePointFit> three_point_pose(const std::vector<Sighting>& sightings,
                                              const ThreePointOptions& options);

// Least squares over the given sightings, rays and depths weighted by their tolerances, from a pose
// that is nearly right. Sightings beyond their tolerance count little (Huber).
Pose refined_pose(const Pose& camera_from_world, const std::vector<Sighting>& sightings,
                  const std::vector<int>& chosen, double ray_tolerance);

// Those that agree with a pose within the tolerances.
std::vector<int> agreeing(const std::vector<Sighting>& sightings, const Pose& camera_from_world,
                          double ray_tolerance);

}  // namespace armsreach::relocalisation
