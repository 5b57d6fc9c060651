#include "vision/mapping/ray_march.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armsreach::mapping {
namespace {

using Eigen::Vector3f;
using Eigen::Vector3i;

// All in voxel edges. A ray that runs along a face, or in it, gains nothing from rounding: every
// step is at least kLeastStep.
constexpr float kLeastStep = 0.05F;
constexpr float kSmallStep = 0.5F;
constexpr float kLargeStep = 2.5F;  // however far the surface: thin things between voxels' rays
constexpr float kNear = 1.75F;      // from here on distances are interpolated

class March {
 public:
  March(Sampler& sampler, const VoxelGrid& grid, const MapRay& ray)
      : sampler_(sampler),
        grid_(grid),
        ray_(ray),
        inverse_(ray.direction.cwiseInverse()),
        t_per_edge_(1 / ray.direction.norm()) {}

  std::optional<SurfaceHit> run(float from, float to) {
    float t = from;
    while (t <= to) {
      const Vector3f point = at(t);
      const Vector3i voxel = point.array().floor().cast<int>();
      const BlockKey key = block_of_voxel(voxel.x(), voxel.y(), voxel.z());
      const float skip = empty_edge(key);
      if (skip > 0) {
        before_.known = false;
        t = exit(t, point, skip);
        continue;
      }
      const VoxelRef here{sampler_.block(key), voxel_in_block(voxel.x(), voxel.y(), voxel.z())};
      if (!here) {
        before_.known = false;
        t += t_per_edge_;
        continue;
      }
      if (here.distance() > kNear) {
        before_ = {t, here.distance(), true};
        t += t_per_edge_ * std::min(here.distance() - 1, kLargeStep);
        continue;
      }
      if (auto hit = step_near(t, point)) return hit;
    }
    return std::nullopt;
  }

 private:
  struct Sample {
    float t = 0;
    float distance = 0;
    bool known = false;
  };

  Vector3f at(float t) const { return ray_.origin + t * ray_.direction; }

  // Edge of the cube around a block that can be skipped: its region's, its own, or 0.
  float empty_edge(const BlockKey& key) {
    const Region* region = sampler_.region(BlockTable::region_of(key));
    if (!region) return kBlockEdge * kRegionEdge;
    const int index = BlockTable::block_in_region(key);
    if ((region->occupied >> index & 1) != 0) return 0;
    // The surface may lie between the last voxel of one block and the first of the next.
    if (before_.known && region->blocks[index]) return 0;
    return region->occupied == 0 ? kBlockEdge * kRegionEdge : kBlockEdge;
  }

  // Parameter just after the cube of this edge that holds the point.
  float exit(float t, const Vector3f& point, float edge) const {
    float nearest = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 3; ++i) {
      if (ray_.direction[i] == 0) continue;
      const float low = std::floor(point[i] / edge) * edge;
      const float wall = ray_.direction[i] > 0 ? low + edge : low;
      nearest = std::min(nearest, (wall - point[i]) * inverse_[i]);
    }
    return t + std::max(nearest, 0.0F) + t_per_edge_ * kLeastStep;
  }

  std::optional<SurfaceHit> step_near(float& t, const Vector3f& point) {
    Cell cell;
    if (!sampler_.cell(point, cell)) {
      before_.known = false;
      t += t_per_edge_ * kSmallStep;
      return std::nullopt;
    }
    const Sample here{t, interpolate(distances(cell.corners), cell.fraction), true};
    if (here.distance <= 0 && before_.known && before_.distance > 0) {
      if (auto hit = refine(before_, here)) return hit;
    }
    before_ = here;
    t += t_per_edge_ * std::clamp(0.8F * here.distance, kSmallStep, kLargeStep);
    return std::nullopt;
  }

  // Regula falsi between a place in front of the surface and one behind it.
  std::optional<SurfaceHit> refine(Sample front, Sample behind) {
    Cell cell;
    for (int iteration = 0; iteration < 3; ++iteration) {
      const float share = front.distance / (front.distance - behind.distance);
      const float t = front.t + share * (behind.t - front.t);
      if (!sampler_.cell(at(t), cell)) return std::nullopt;
      const float distance = interpolate(distances(cell.corners), cell.fraction);
      (distance > 0 ? front : behind) = {t, distance, true};
      if (std::abs(distance) < 0.01F) break;
    }
    if (!occupied(cell.corners, grid_.occupied_above)) return std::nullopt;
    SurfaceHit hit;
    hit.t = std::abs(front.distance) < std::abs(behind.distance) ? front.t : behind.t;
    hit.intensity = interpolate(intensities(cell.corners), cell.fraction);
    hit.normal = gradient(distances(cell.corners), cell.fraction).normalized();
    return hit;
  }

  Sampler& sampler_;
  const VoxelGrid& grid_;
  const MapRay& ray_;
  Vector3f inverse_;
  float t_per_edge_;
  Sample before_;
};

}  // namespace

std::optional<SurfaceHit> march(Sampler& sampler, const VoxelGrid& grid, const MapRay& ray,
                                float from, float to) {
  return March(sampler, grid, ray).run(from, to);
}

}  // namespace armsreach::mapping
