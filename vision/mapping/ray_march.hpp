// Follows one ray to the first mapped surface.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vision/mapping/sampler.hpp"

namespace armsreach::mapping {

// A ray in voxel edges: origin + t * direction.
struct MapRay {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
};

struct SurfaceHit {
  float t = 0;
  float intensity = 0;
  Eigen::Vector3f normal;  // towards the free side, unit
};

// First place within [from, to] where the interpolated signed distance falls through zero beside an
// occupied voxel.
std::optional<SurfaceHit> march(Sampler& sampler, const VoxelGrid& grid, const MapRay& ray,
                                float from, float to);

}  // namespace armsreach::mapping
