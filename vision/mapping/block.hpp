// The map's storage unit: a block of 8x8x8 voxels in cubes of 2x2x2, eight bytes a voxel. A cube is
// one cache line and one vector of eight lanes; cubes fill better than rows with the thin shells
// that depth images touch, however the shell lies, and an interpolation reads 3.4 lines in the
// mean. Voxel (i, j, k) of the world covers [i, i+1) x [j, j+1) x [k, k+1) voxel edges, as in
// OctoMap; a block key is its voxel index / 8.
#pragma once

#include <algorithm>
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

struct alignas(64) VoxelCube {
  std::int16_t log_odds[8] = {};    // of being occupied; 0 was never seen
  std::int16_t distance[8] = {};    // to the surface, positive on its free side
  std::uint16_t weight[8] = {};     // of `distance`; 0: unknown
  std::uint16_t intensity[8] = {};  // 0..1 of the surface near this voxel
};

struct Block {
  VoxelCube cubes[kBlockVoxels / 8];
  std::uint64_t epoch = 0;  // of the table that may write it, see BlockTable
  bool occupied = false;    // has a voxel above the occupancy threshold

  std::int16_t& log_odds(int place) { return cubes[place >> 3].log_odds[place & 7]; }
  std::int16_t& distance(int place) { return cubes[place >> 3].distance[place & 7]; }
  std::uint16_t& weight(int place) { return cubes[place >> 3].weight[place & 7]; }
  std::uint16_t& intensity(int place) { return cubes[place >> 3].intensity[place & 7]; }
  std::int16_t log_odds(int place) const { return cubes[place >> 3].log_odds[place & 7]; }
  std::int16_t distance(int place) const { return cubes[place >> 3].distance[place & 7]; }
  std::uint16_t weight(int place) const { return cubes[place >> 3].weight[place & 7]; }
  std::uint16_t intensity(int place) const { return cubes[place >> 3].intensity[place & 7]; }
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

inline bool has_occupied(const Block& block, std::int16_t above) {
  std::int16_t highest[8] = {INT16_MIN, INT16_MIN, INT16_MIN, INT16_MIN,
                             INT16_MIN, INT16_MIN, INT16_MIN, INT16_MIN};
  for (const VoxelCube& cube : block.cubes) {
    for (int i = 0; i < 8; ++i) {
      highest[i] = cube.log_odds[i] > highest[i] ? cube.log_odds[i] : highest[i];
    }
  }
  return *std::max_element(highest, highest + 8) > above;
}

inline constexpr BlockKey block_of_voxel(int x, int y, int z) { return {x >> 3, y >> 3, z >> 3}; }

}  // namespace armsreach::mapping
