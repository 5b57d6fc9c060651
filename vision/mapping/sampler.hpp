// Reads the map between voxel centres. Coordinates are in voxel edges: voxel (i, j, k) has its
// centre at (i + 0.5, j + 0.5, k + 0.5).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "vision/mapping/block.hpp"
#include "vision/mapping/block_table.hpp"
#include "vision/mapping/voxel_grid.hpp"

namespace armsreach::mapping {

// A voxel in place.
struct VoxelRef {
  const Block* block = nullptr;  // null: nothing is known around here
  int at = 0;

  explicit operator bool() const { return block != nullptr && block->weight(at) != 0; }
  float distance() const { return static_cast<float>(block->distance(at)) * kDistanceUnit; }
  float intensity() const { return static_cast<float>(block->intensity(at)) * kIntensityUnit; }
};

// The eight voxels around a point and the point's place among them.
struct Cell {
  std::array<VoxelRef, 8> corners;  // x fastest, then y, then z
  Eigen::Vector3f fraction;         // 0..1
};

// Remembers the last region and block, as neighbouring questions mostly fall into them.
class Sampler {
 public:
  explicit Sampler(const VoxelGrid& grid) : grid_(grid) {}

  const Region* region(const BlockKey& key) {
    if (key != region_key_) {
      region_key_ = key;
      region_ = grid_.blocks.find_region(key);
    }
    return region_;
  }
  const Block* block(const BlockKey& key) {
    if (key != block_key_) {
      block_key_ = key;
      const Region* found = region(BlockTable::region_of(key));
      block_ = found ? found->blocks[BlockTable::block_in_region(key)].get() : nullptr;
    }
    return block_;
  }
  VoxelRef voxel(int x, int y, int z) {
    return {block(block_of_voxel(x, y, z)), voxel_in_block(x, y, z)};
  }

  // False when a corner is unknown.
  bool cell(const Eigen::Vector3f& point, Cell& out) {
    const Eigen::Vector3f shifted = point.array() - 0.5F;
    const Eigen::Vector3f low(std::floor(shifted.x()), std::floor(shifted.y()),
                              std::floor(shifted.z()));
    out.fraction = shifted - low;
    return corners(
        {static_cast<int>(low.x()), static_cast<int>(low.y()), static_cast<int>(low.z())},
        out.corners);
  }
  bool corners(const Eigen::Vector3i& base, std::array<VoxelRef, 8>& out) {
    const int x = base.x();
    const int y = base.y();
    const int z = base.z();
    // Bit i: the cell reaches into the next block along axis i.
    constexpr int kLast = kBlockEdge - 1;
    const int crossing = ((x & kLast) == kLast ? 1 : 0) + ((y & kLast) == kLast ? 2 : 0) +
                         ((z & kLast) == kLast ? 4 : 0);
    const int places_x[2] = {place_of_x(x), place_of_x(x + 1)};
    const int places_y[2] = {place_of_y(y), place_of_y(y + 1)};
    const int places_z[2] = {place_of_z(z), place_of_z(z + 1)};
    out[0].block = block(block_of_voxel(x, y, z));
    if (!out[0].block) return false;
    bool known = true;
    for (int i = 0; i < 8; ++i) {
      const int owner = i & crossing;  // the first corner in the same block
      if (owner == i && i != 0) {
        out[i].block = block(block_of_voxel(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)));
        if (!out[i].block) return false;
      }
      out[i].block = out[owner].block;
      out[i].at = places_x[i & 1] + places_y[i >> 1 & 1] + places_z[i >> 2];
      known &= out[i].block->weight(out[i].at) != 0;
    }
    return known;
  }

 private:
  static constexpr BlockKey kNowhere{1 << 30, 0, 0};
  const VoxelGrid& grid_;
  BlockKey region_key_ = kNowhere;
  BlockKey block_key_ = kNowhere;
  const Region* region_ = nullptr;
  const Block* block_ = nullptr;
};

// Trilinear interpolation of the eight corners' values (x fastest).
inline float interpolate(const std::array<float, 8>& v, const Eigen::Vector3f& f) {
  const float a = v[0] + f.x() * (v[1] - v[0]);
  const float b = v[2] + f.x() * (v[3] - v[2]);
  const float c = v[4] + f.x() * (v[5] - v[4]);
  const float d = v[6] + f.x() * (v[7] - v[6]);
  const float near = a + f.y() * (b - a);
  const float far = c + f.y() * (d - c);
  return near + f.z() * (far - near);
}

inline std::array<float, 8> distances(const std::array<VoxelRef, 8>& corners) {
  std::array<float, 8> values;
  for (std::size_t i = 0; i < 8; ++i) values[i] = corners[i].distance();
  return values;
}
inline std::array<float, 8> intensities(const std::array<VoxelRef, 8>& corners) {
  std::array<float, 8> values;
  for (std::size_t i = 0; i < 8; ++i) values[i] = corners[i].intensity();
  return values;
}

// Gradient of the interpolated value, per voxel edge.
inline Eigen::Vector3f gradient(const std::array<float, 8>& v, const Eigen::Vector3f& f) {
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  return {mix(mix(v[1] - v[0], v[3] - v[2], f.y()), mix(v[5] - v[4], v[7] - v[6], f.y()), f.z()),
          mix(mix(v[2] - v[0], v[3] - v[1], f.x()), mix(v[6] - v[4], v[7] - v[5], f.x()), f.z()),
          mix(mix(v[4] - v[0], v[5] - v[1], f.x()), mix(v[6] - v[2], v[7] - v[3], f.x()), f.y())};
}

// Whether one of the voxels is occupied: the distance alone also keeps what was since cleared.
inline bool occupied(const std::array<VoxelRef, 8>& corners, std::int16_t above) {
  for (const VoxelRef& corner : corners) {
    if (corner.block->log_odds(corner.at) > above) return true;
  }
  return false;
}

}  // namespace armsreach::mapping
