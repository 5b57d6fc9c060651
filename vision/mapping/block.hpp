// The map's storage unit: a block of 8x8x8 voxels, eight bytes a voxel, one array a quantity so
// that a row of eight voxels loads as one vector. Voxel (i, j, k) of the world covers [i, i+1) x
// [j, j+1) x [k, k+1) voxel edges, as in OctoMap; a block key is its voxel index / 8.
#pragma once

#include <compare>
#include <cstdint>

namespace armsreach::mapping {

inline constexpr int kBlockEdge = 8;  // voxels
inline constexpr int kBlockVoxels = kBlockEdge * kBlockEdge * kBlockEdge;

// Fixed point: what one unit of the stored integers means.
inline constexpr float kLogOddsUnit = 1.0F / 1024;
inline constexpr float kDistanceUnit = 1.0F / 1024;  // voxel edges
inline constexpr float kWeightUnit = 1.0F / 64;      // one frontal observation from 1 m weighs 1
inline constexpr float kIntensityUnit = 1.0F / 65535;

struct BlockKey {
  int x = 0;
  int y = 0;
  int z = 0;
  auto operator<=>(const BlockKey&) const = default;
};

struct alignas(32) Block {
  std::int16_t log_odds[kBlockVoxels] = {};    // of being occupied; 0 was never seen
  std::int16_t distance[kBlockVoxels] = {};    // to the surface, positive on its free side
  std::uint16_t weight[kBlockVoxels] = {};     // of `distance`; 0: unknown
  std::uint16_t intensity[kBlockVoxels] = {};  // 0..1 of the surface near this voxel
  std::uint64_t epoch = 0;                     // of the table that may write it, see BlockTable
  bool occupied = false;                       // has a voxel above the occupancy threshold
};

// Place of a voxel in its block's arrays: x, y, z within the cube, then the cube's x, y, z. The
// three coordinates' shares simply add up.
inline constexpr int place_of_x(int x) { return (x & 1) + 4 * (x & 6); }
inline constexpr int place_of_y(int y) { return 2 * (y & 1) + 16 * (y & 6); }
inline constexpr int place_of_z(int z) { return 4 * (z & 1) + 64 * (z & 6); }
inline constexpr int voxel_in_block(int x, int y, int z) {
  return place_of_x(x) + place_of_y(y) + place_of_z(z);
}
struct VoxelInBlock {
  int x, y, z;
};
inline constexpr VoxelInBlock voxel_at(int place) {
  return {(place & 1) + (place >> 2 & 6), (place >> 1 & 1) + (place >> 4 & 6),
          (place >> 2 & 1) + (place >> 6 & 6)};
}

inline constexpr BlockKey block_of_voxel(int x, int y, int z) { return {x >> 3, y >> 3, z >> 3}; }

}  // namespace armsreach::mapping
