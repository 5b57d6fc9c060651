#include "vision/mapping/surface.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "vision/mapping/sampler.hpp"

namespace armsreach::mapping {
namespace {

using Eigen::Vector3f;

constexpr int kPadded = kBlockEdge + 1;
constexpr std::uint8_t kFree = 1;
constexpr std::uint8_t kBehind = 2;
constexpr std::uint8_t kUnknown = 4;

// Signs of a block's voxels and of the first ones of its neighbours.
using Signs = std::array<std::uint8_t, kPadded * kPadded * kPadded>;

int padded(int x, int y, int z) { return x + kPadded * (y + kPadded * z); }

// False when no surface can pass.
bool read_signs(const VoxelGrid& grid, const BlockKey& key, Signs& signs) {
  std::array<const Block*, 8> blocks;
  bool occupied = false;
  for (int i = 0; i < 8; ++i) {
    blocks[i] = grid.blocks.find({key.x + (i & 1), key.y + (i >> 1 & 1), key.z + (i >> 2)});
    occupied |= blocks[i] && blocks[i]->occupied;
  }
  if (!blocks[0] || !occupied) return false;
  for (int z = 0; z < kPadded; ++z) {
    for (int y = 0; y < kPadded; ++y) {
      for (int x = 0; x < kPadded; ++x) {
        const Block* block = blocks[(x >> 3) + 2 * (y >> 3) + 4 * (z >> 3)];
        const int at = voxel_in_block(x, y, z);
        signs[padded(x, y, z)] = !block || block->weight(at) == 0 ? kUnknown
                                 : block->distance(at) > 0        ? kFree
                                                                  : kBehind;
      }
    }
  }
  return true;
}

bool crosses(const Signs& signs, int x, int y, int z) {
  const std::uint8_t* at = &signs[padded(x, y, z)];
  constexpr int kY = kPadded;
  constexpr int kZ = kPadded * kPadded;
  return (at[0] | at[1] | at[kY] | at[kY + 1] | at[kZ] | at[kZ + 1] | at[kZ + kY] |
          at[kZ + kY + 1]) == (kFree | kBehind);
}

// Mean of the places where the cell's edges meet the surface.
Vector3f mean_crossing(const std::array<float, 8>& distance) {
  Vector3f sum = Vector3f::Zero();
  int count = 0;
  for (int from = 0; from < 8; ++from) {
    for (int axis = 0; axis < 3; ++axis) {
      const int to = from | 1 << axis;
      if (to == from || (distance[from] > 0) == (distance[to] > 0)) continue;
      Vector3f crossing(static_cast<float>(from & 1), static_cast<float>(from >> 1 & 1),
                        static_cast<float>(from >> 2));
      crossing[axis] = distance[from] / (distance[from] - distance[to]);
      sum += crossing;
      ++count;
    }
  }
  return sum / static_cast<float>(count);
}

}  // namespace

std::vector<SurfacePoint> surface_points(const VoxelGrid& grid, const BlockKey& key) {
  std::vector<SurfacePoint> points;
  Signs signs;
  if (!read_signs(grid, key, signs)) return points;
  Sampler sampler(grid);
  std::array<VoxelRef, 8> corners;
  for (int z = 0; z < kBlockEdge; ++z) {
    for (int y = 0; y < kBlockEdge; ++y) {
      for (int x = 0; x < kBlockEdge; ++x) {
        if (!crosses(signs, x, y, z)) continue;
        const Eigen::Vector3i base =
            kBlockEdge * Eigen::Vector3i(key.x, key.y, key.z) + Eigen::Vector3i(x, y, z);
        if (!sampler.corners(base, corners) || !occupied(corners, grid.occupied_above)) continue;
        const std::array<float, 8> distance = distances(corners);
        Vector3f place = mean_crossing(distance);
        const Vector3f slope = gradient(distance, place);
        if (!(slope.squaredNorm() > 0.01F)) continue;
        // One Newton step puts the mean onto the surface; it stays in the cell.
        place -= slope * (interpolate(distance, place) / slope.squaredNorm());
        place = place.cwiseMax(0.0F).cwiseMin(1.0F);
        const Vector3f voxels = base.cast<float>() + place + Vector3f::Constant(0.5F);
        points.push_back({voxels * static_cast<float>(grid.resolution), slope.normalized(),
                          interpolate(intensities(corners), place)});
      }
    }
  }
  return points;
}

std::vector<BlockKey> changed_surface(const VoxelGrid& grid, const std::vector<BlockKey>& changed) {
  std::vector<BlockKey> keys = changed;
  for (const BlockKey& key : changed) {
    for (int i = 1; i < 8; ++i) {
      const BlockKey before{key.x - (i & 1), key.y - (i >> 1 & 1), key.z - (i >> 2)};
      if (grid.blocks.find(before)) keys.push_back(before);
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

}  // namespace armsreach::mapping
