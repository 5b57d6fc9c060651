#include "vision/mapping/ray_march.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armsreach::mapping {
namespace {

using Eigen::Vector3f;

// All in voxel edges. Every step is at least kLeastStep, so that a ray along a face, or in it, goes
// on whatever rounding says.
constexpr float kLeastStep = 0.05F;
constexpr float kSmallStep = 0.5F;
constexpr float kUnknownStep = 1.5F;  // known free space is two edges deep in front of any surface
constexpr float kLargeStep = 2.5F;    // however far the surface: another may stand beside
constexpr float kNear = 1.75F;        // from here on distances are interpolated
constexpr float kOnSurface = 0.15F;   // so near one more linear step is exact

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
      const int x = static_cast<int>(std::floor(point.x()));
      const int y = static_cast<int>(std::floor(point.y()));
      const int z = static_cast<int>(std::floor(point.z()));
      const BlockKey key = block_of_voxel(x, y, z);
      const float skip = empty_edge(key);
      if (skip > 0) {
        if (!retreat(t)) t = exit(t, point, skip);
        continue;
      }
      const VoxelRef here{sampler_.block(key), voxel_in_block(x, y, z)};
      if (!here) {
        if (!retreat(t)) t += kUnknownStep * t_per_edge_;
      } else if (here.distance() > kNear) {
        before_ = {t, here.distance(), true};
        t += t_per_edge_ * std::min(here.distance() - 1, kLargeStep);
      } else if (auto hit = approach(t)) {
        return hit;
      }
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

  // Nothing is known at t. When the step there was a long one from known free space, it may have
  // gone through a surface: back to half of it. Else what was known is left behind.
  bool retreat(float& t) {
    if (before_.known && t - before_.t > t_per_edge_ * kSmallStep) {
      t = before_.t + (t - before_.t) / 2;
      return true;
    }
    before_.known = false;
    return false;
  }

  // Edge of the cube around a block that can be skipped: its region's, its own, or 0.
  float empty_edge(const BlockKey& key) {
    const Region* region = sampler_.region(BlockTable::region_of(key));
    if (!region || region->occupied == 0) return kBlockEdge * kRegionEdge;
    const int index = BlockTable::block_in_region(key);
    if ((region->occupied >> index & 1) != 0) return 0;
    // The surface may lie between the last voxel of one block and the first of the next.
    return before_.known && region->blocks[index] ? 0 : kBlockEdge;
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

  // One interpolated sample at t: a hit, or t moved on along the slope of the distance.
  std::optional<SurfaceHit> approach(float& t) {
    Cell cell;
    if (!sampler_.cell(at(t), cell)) {
      if (!retreat(t)) t += t_per_edge_ * kSmallStep;
      return std::nullopt;
    }
    const std::array<float, 8> corner = distances(cell.corners);
    const float distance = interpolate(corner, cell.fraction);
    const float slope = gradient(corner, cell.fraction).dot(ray_.direction);
    const bool falls = slope < 0;
    if (falls && std::abs(distance) < kOnSurface && (distance > 0 || before_.known)) {
      const float correction = std::clamp(-distance / slope, -t_per_edge_, t_per_edge_);
      if (auto hit = settle(cell, t, correction)) return hit;
    } else if (distance <= 0 && before_.known && before_.distance > 0) {
      if (auto hit = bisect(before_, {t, distance, true})) return hit;
    }
    before_ = {t, distance, true};
    // Newton's step where the distance falls, aimed a little short of the surface.
    const float newton = falls ? -distance / slope : 0;
    const float most = t_per_edge_ * kLargeStep;
    const float least = t_per_edge_ * (distance > 0 ? kOnSurface : kSmallStep);
    t += std::clamp(newton, least, most);
    return std::nullopt;
  }

  // Regula falsi between a place in front of the surface and one behind it.
  std::optional<SurfaceHit> bisect(Sample front, Sample behind) {
    Cell cell;
    float t = behind.t;
    for (int iteration = 0; iteration < 4; ++iteration) {
      const float share = front.distance / (front.distance - behind.distance);
      t = front.t + share * (behind.t - front.t);
      if (!sampler_.cell(at(t), cell)) return std::nullopt;
      const float distance = interpolate(distances(cell.corners), cell.fraction);
      if (std::abs(distance) < 0.01F) break;
      (distance > 0 ? front : behind) = {t, distance, true};
    }
    return settle(cell, t, 0);
  }

  std::optional<SurfaceHit> settle(const Cell& cell, float t, float correction) const {
    if (!occupied(cell.corners, grid_.occupied_above)) return std::nullopt;
    const Vector3f fraction =
        (cell.fraction + correction * ray_.direction).cwiseMax(0.0F).cwiseMin(1.0F);
    return SurfaceHit{t + correction, interpolate(intensities(cell.corners), fraction),
                      gradient(distances(cell.corners), fraction).normalized()};
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
