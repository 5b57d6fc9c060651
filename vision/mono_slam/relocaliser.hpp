// Finds the camera again in a known map: templates are sought in the whole image, three-point poses
// are tried on what resembles them, and the best must be confirmed by points seen where it says.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "vision/mono_slam/filter.hpp"
#include "vision/mono_slam/landmark.hpp"
#include "vision/mono_slam/pose_from_points.hpp"
#include "vision/mono_slam/search.hpp"

namespace armsreach::mono_slam {

struct RelocaliserOptions {
  double least_score = 0.75;   // ZNCC of a place that resembles a template
  int most_places = 3;         // of them
  int most_samples = 400;      // triples of points
  double pixel_tolerance = 3;  // between a place and a hypothesis
  int least_supporters = 6;    // of a hypothesis that is looked into
  int least_confirmed = 8;     // points found where the pose says
  double least_share = 0.5;    // of those that should be visible
};

struct KnownPoint {
  const Landmark* landmark;
  Eigen::Vector3d point_in_world;
};

struct Relocalisation {
  Pose world_from_camera;
  struct Confirmed {
    PointId id;
    Eigen::Vector2d pixel;
  };
  std::vector<Confirmed> confirmed;
};

std::optional<Relocalisation> relocalise(const SearchImage& image, const Camera& camera,
                                         const std::vector<KnownPoint>& points,
                                         const LandmarkRules& rules,
                                         const RelocaliserOptions& options,
                                         std::mt19937_64* random);

}  // namespace armsreach::mono_slam
