#include "vision/mapping/band_blocks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "vision/mapping/block_table.hpp"

namespace armsreach::mapping {
namespace {

using Eigen::Array3f;
using Eigen::Array3i;
using Eigen::Vector3f;

Array3i floored(const Array3f& a) { return a.floor().cast<int>(); }

// A bit for each block of a box.
class BlockSet {
 public:
  BlockSet(const Array3i& low, const Array3i& high)
      : low_(low),
        size_(high - low + 1),
        bits_((static_cast<std::size_t>(size_.prod()) + 63) / 64) {}

  void add_box(const Array3i& low, const Array3i& high) {
    const Array3i from = (low - low_).max(0);
    const Array3i to = (high - low_).min(size_ - 1);
    for (int x = from.x(); x <= to.x(); ++x) {
      for (int y = from.y(); y <= to.y(); ++y) {
        const std::size_t line = (static_cast<std::size_t>(x) * size_.y() + y) * size_.z();
        for (int z = from.z(); z <= to.z(); ++z) {
          const std::size_t bit = line + z;
          bits_[bit / 64] |= std::uint64_t{1} << (bit % 64);
        }
      }
    }
  }

  std::vector<BlockKey> sorted() const {
    std::vector<BlockKey> keys;
    for (std::size_t word = 0; word < bits_.size(); ++word) {
      for (std::uint64_t rest = bits_[word]; rest != 0; rest &= rest - 1) {
        const auto bit = static_cast<int>(word * 64) + std::countr_zero(rest);
        const int z = bit % size_.z();
        const int y = bit / size_.z() % size_.y();
        const int x = bit / size_.z() / size_.y();
        const BlockKey key{x + low_.x(), y + low_.y(), z + low_.z()};
        if (BlockTable::in_limits(key)) keys.push_back(key);
      }
    }
    return keys;
  }

 private:
  Array3i low_;
  Array3i size_;
  std::vector<std::uint64_t> bits_;
};

// Part of a pixel's (or a tile of pixels') cone: from `near` to `far` along z.
struct Cone {
  float u, v;       // px, its axis
  float pixels;     // its width
  float near, far;  // m
};

// The cones' parts in the band. Tiles of pixels that see one surface are taken together.
class Cones {
 public:
  Cones(const DepthPlanes& planes, const Camera& camera, const SensorModel& sensor, double voxel)
      : planes_(planes), camera_(camera), sensor_(sensor), voxel_(voxel) {}

  std::vector<Cone> all() const {
    std::vector<Cone> cones;
    const int tile = std::max(1, planes_.width / 160);
    for (int v = 0; v < planes_.height; v += tile) {
      for (int u = 0; u < planes_.width; u += tile) add_tile(u, v, tile, cones);
    }
    return cones;
  }

 private:
  void add_tile(int u0, int v0, int tile, std::vector<Cone>& cones) const {
    const int u1 = std::min(u0 + tile, planes_.width);
    const int v1 = std::min(v0 + tile, planes_.height);
    const std::size_t first = cones.size();
    Cone whole{static_cast<float>(u0 + u1 - 1) / 2, static_cast<float>(v0 + v1 - 1) / 2,
               static_cast<float>(tile), 1e9F, 0};
    for (int v = v0; v < v1; ++v) {
      for (int u = u0; u < u1; ++u) {
        if (planes_.at(u, v).distance <= 0) continue;
        cones.push_back(pixel_cone(u, v));
        whole.near = std::min(whole.near, cones.back().near);
        whole.far = std::max(whole.far, cones.back().far);
      }
    }
    const std::size_t count = cones.size() - first;
    if (count < 2) return;
    const float depth = cones[first].far - cones[first].near;
    if (whole.far - whole.near > 2 * depth) return;  // a depth edge: pixel by pixel
    cones.resize(first);
    cones.push_back(whole);
  }

  Cone pixel_cone(int u, int v) const {
    const PixelPlane& plane = planes_.at(u, v);
    const Eigen::Vector3d ray((u - camera_.cx) / camera_.fx, (v - camera_.cy) / camera_.fy, 1);
    const double slope = along(plane, ray);
    const double depth = static_cast<double>(plane.distance) * voxel_ / slope;
    // How far the plane's depth moves within the pixel, and the two voxels that are kept behind
    // slanted surfaces for interpolation.
    const double slant = 0.5 * (static_cast<double>(std::abs(plane.x)) / camera_.fx +
                                static_cast<double>(std::abs(plane.y)) / camera_.fy);
    const double half = std::max(sensor_.band(depth, voxel_), 2 * voxel_ * ray.norm() / slope) +
                        depth * std::min(slant / slope, 0.2);
    return {static_cast<float>(u), static_cast<float>(v), 1,
            static_cast<float>(std::max(depth - half, 0.0)), static_cast<float>(depth + half)};
  }

  const DepthPlanes& planes_;
  const Camera& camera_;
  const SensorModel& sensor_;
  double voxel_;
};

}  // namespace

std::vector<BlockKey> band_blocks(const DepthPlanes& planes, const Camera& camera,
                                  const Pose& world_from_camera, const SensorModel& sensor,
                                  double voxel) {
  const std::vector<Cone> cones = Cones(planes, camera, sensor, voxel).all();
  if (cones.empty()) return {};

  const float per_block = static_cast<float>(1 / (voxel * kBlockEdge));
  const Eigen::Matrix3f rotation = world_from_camera.rotation_matrix().cast<float>() * per_block;
  const Vector3f origin = world_from_camera.translation().cast<float>() * per_block;
  const auto at = [&](const Cone& cone, float z) -> Array3f {
    const Vector3f ray((cone.u - static_cast<float>(camera.cx)) / static_cast<float>(camera.fx),
                       (cone.v - static_cast<float>(camera.cy)) / static_cast<float>(camera.fy), 1);
    return (origin + rotation * (ray * z)).array();
  };
  const float radius_per_depth =
      static_cast<float>(std::sqrt(0.5) / std::min(camera.fx, camera.fy)) * per_block;
  const auto radius = [&](const Cone& cone) { return radius_per_depth * cone.pixels * cone.far; };

  Array3f low = at(cones.front(), cones.front().far);
  Array3f high = low;
  for (const Cone& cone : cones) {
    for (const float z : {cone.near, cone.far}) {
      low = low.min(at(cone, z) - radius(cone));
      high = high.max(at(cone, z) + radius(cone));
    }
  }
  BlockSet blocks(floored(low), floored(high));
  for (const Cone& cone : cones) {
    const float margin = radius(cone);
    const float length = (at(cone, cone.far) - at(cone, cone.near)).matrix().norm();
    const int parts = std::max(1, static_cast<int>(std::ceil(2 * length)));  // half a block each
    Array3f from = at(cone, cone.near);
    for (int part = 1; part <= parts; ++part) {
      const float share = static_cast<float>(part) / static_cast<float>(parts);
      const Array3f to = at(cone, cone.near + share * (cone.far - cone.near));
      blocks.add_box(floored(from.min(to) - margin), floored(from.max(to) + margin));
      from = to;
    }
  }
  return blocks.sorted();
}

}  // namespace armsreach::mapping
