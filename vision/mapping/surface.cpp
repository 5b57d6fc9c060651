#include "vision/mapping/surface.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "vision/mapping/sampler.hpp"

namespace armsreach::mapping {
namespace {

using Eigen::Vector3f;

constexpr int kPadded = kBlockEdge + 1;

// A block's voxels and the first ones of the blocks after it: a bit for each, x along the bits.
class Signs {
 public:
  Signs(const VoxelGrid& grid, const BlockKey& key) {
    std::array<const Block*, 8> blocks;
    for (int i = 0; i < 8; ++i) {
      blocks[i] = grid.blocks.find({key.x + (i & 1), key.y + (i >> 1 & 1), key.z + (i >> 2)});
      occupied_ |= blocks[i] && blocks[i]->occupied;
    }
    occupied_ &= blocks[0] != nullptr;
    if (!occupied_) return;
    for (int i = 0; i < 8; ++i) {
      if (blocks[i]) add(*blocks[i], i & 1, i >> 1 & 1, i >> 2);
    }
  }

  // False when no surface can pass through any cell.
  bool occupied() const { return occupied_; }

  // A bit for each of a line's eight cells: all its corners are known, not all on one side.
  std::uint32_t crossed(int y, int z) const {
    const Line& a = lines_[y][z];
    const Line& b = lines_[y + 1][z];
    const Line& c = lines_[y][z + 1];
    const Line& d = lines_[y + 1][z + 1];
    const std::uint32_t known = a.known & b.known & c.known & d.known;
    const std::uint32_t any_free = a.free | b.free | c.free | d.free;
    const std::uint32_t all_free = a.free & b.free & c.free & d.free;
    return known & known >> 1 & (any_free | any_free >> 1) & ~(all_free & all_free >> 1) & 0xFF;
  }

 private:
  struct Line {
    std::uint32_t known = 0;
    std::uint32_t free = 0;
  };

  // The voxels of the block that lies `bx`, `by`, `bz` blocks further, cube by cube.
  void add(const Block& block, int bx, int by, int bz) {
    for (int z = 0; z < (bz != 0 ? 1 : kBlockEdge); z += 2) {
      for (int y = 0; y < (by != 0 ? 1 : kBlockEdge); y += 2) {
        for (int x = 0; x < (bx != 0 ? 1 : kBlockEdge); x += 2) {
          add(block.cubes[voxel_in_block(x, y, z) >> 3], x + kBlockEdge * bx, y + kBlockEdge * by,
              z + kBlockEdge * bz);
        }
      }
    }
  }
  void add(const VoxelCube& cube, int x, int y, int z) {
    std::uint32_t known = 0;
    std::uint32_t free = 0;
    for (int i = 0; i < 8; ++i) {
      known |= static_cast<std::uint32_t>(cube.weight[i] != 0) << i;
      free |= static_cast<std::uint32_t>(cube.distance[i] > 0) << i;
    }
    free &= known;
    for (int i = 0; i < 4; ++i) {
      // Of a neighbour's cubes only the voxels next to the block matter.
      if (y + (i & 1) >= kPadded || z + (i >> 1) >= kPadded) continue;
      Line& line = lines_[y + (i & 1)][z + (i >> 1)];
      line.known |= (known >> (2 * i) & 3) << x;
      line.free |= (free >> (2 * i) & 3) << x;
    }
  }

  std::array<std::array<Line, kPadded>, kPadded> lines_{};
  bool occupied_ = false;
};

std::uint8_t free_corners(const std::array<float, 8>& distance) {
  unsigned free = 0;
  for (unsigned i = 0; i < 8; ++i) free |= static_cast<unsigned>(distance[i] > 0) << i;
  return static_cast<std::uint8_t>(free);
}

// Mean of the places where the cell's edges meet the surface.
Vector3f mean_crossing(const std::array<float, 8>& distance, std::uint8_t free) {
  Vector3f sum = Vector3f::Zero();
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    constexpr unsigned kFirst[3] = {0x55, 0x33, 0x0F};  // corners that an edge along an axis leaves
    const int step = 1 << axis;
    for (unsigned rest = (free ^ free >> step) & kFirst[axis]; rest != 0; rest &= rest - 1) {
      const int from = std::countr_zero(rest);
      Vector3f crossing(static_cast<float>(from & 1), static_cast<float>(from >> 1 & 1),
                        static_cast<float>(from >> 2));
      crossing[axis] = distance[from] / (distance[from] - distance[from + step]);
      sum += crossing;
      ++count;
    }
  }
  return sum / static_cast<float>(count);
}

}  // namespace

std::vector<SurfacePoint> surface_points(const VoxelGrid& grid, const BlockKey& key,
                                         std::vector<SurfaceCell>* cells) {
  std::vector<SurfacePoint> points;
  const Signs signs(grid, key);
  if (!signs.occupied()) return points;
  Sampler sampler(grid);
  std::array<VoxelRef, 8> corners;
  const auto add = [&](int x, int y, int z) {
    const Eigen::Vector3i base =
        kBlockEdge * Eigen::Vector3i(key.x, key.y, key.z) + Eigen::Vector3i(x, y, z);
    if (!sampler.corners(base, corners) || !occupied(corners, grid.occupied_above)) return;
    const std::array<float, 8> distance = distances(corners);
    const std::uint8_t free = free_corners(distance);
    Vector3f place = mean_crossing(distance, free);
    const Vector3f slope = gradient(distance, place);
    if (!(slope.squaredNorm() > 0.01F)) return;
    // One Newton step puts the mean onto the surface; it stays in the cell.
    place -= slope * (interpolate(distance, place) / slope.squaredNorm());
    place = place.cwiseMax(0.0F).cwiseMin(1.0F);
    const Vector3f voxels = base.cast<float>() + place + Vector3f::Constant(0.5F);
    points.push_back({voxels * static_cast<float>(grid.resolution), slope.normalized(),
                      interpolate(intensities(corners), place)});
    if (!cells) return;
    cells->push_back({static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y),
                      static_cast<std::uint8_t>(z), free});
  };
  for (int z = 0; z < kBlockEdge; ++z) {
    for (int y = 0; y < kBlockEdge; ++y) {
      for (std::uint32_t rest = signs.crossed(y, z); rest != 0; rest &= rest - 1) {
        add(std::countr_zero(rest), y, z);
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
