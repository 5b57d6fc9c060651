#include "vision/mapping/depth_band.hpp"

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

constexpr DepthInterval kNothing{1e9F, -1e9F};

void widen(DepthInterval& interval, const DepthInterval& other) {
  interval.near = std::min(interval.near, other.near);
  interval.far = std::max(interval.far, other.far);
}

}  // namespace

DepthBand::DepthBand(const DepthPlanes& planes, const Camera& camera, const SensorModel& sensor,
                     double voxel)
    : planes_(planes),
      camera_(camera),
      sensor_(sensor),
      voxel_(voxel),
      tile_(std::max(1, planes.width / 80)),
      columns_((planes.width + tile_ - 1) / tile_),
      rows_((planes.height + tile_ - 1) / tile_),
      tiles_(static_cast<std::size_t>(columns_) * rows_, Depths{kNothing, 0}) {
  sensor_.noise *= voxel;  // sigma in voxel edges for depths in voxel edges
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) add_tile(column, row);
  }
}

DepthBand::Depths DepthBand::pixel_depths(int u, int v) const {
  const PixelPlane& plane = planes_.at(u, v);
  const auto fx = static_cast<float>(camera_.fx);
  const auto fy = static_cast<float>(camera_.fy);
  const float x = (static_cast<float>(u) - static_cast<float>(camera_.cx)) / fx;
  const float y = (static_cast<float>(v) - static_cast<float>(camera_.cy)) / fy;
  const float along = plane.x * x + plane.y * y + plane.z;
  const float depth = std::abs(plane.distance) / along;
  // How far the plane's depth moves within the pixel.
  const float slant = (std::abs(plane.x) / fx + std::abs(plane.y) / fy) / (2 * along);
  const float slack = depth * std::min(slant, 0.2F);
  // Interpolation wants two voxels behind the surface, however slanted; see
  // update_block_kernel.cpp.
  const float sigma = static_cast<float>(sensor_.sigma(static_cast<double>(depth)));
  const float per_distance = std::sqrt(1 + x * x + y * y) / along;
  const float behind = std::max(3 * sigma, 2 * std::max(sigma, 1.0F) * per_distance);
  const float band = 3 * sigma + 3;
  const float front = std::max(band, 2 * per_distance);
  return {{std::max(depth - front - slack, 0.0F), depth + behind + slack}, depth + slack - band};
}

void DepthBand::add_tile(int column, int row) {
  const int u0 = column * tile_;
  const int v0 = row * tile_;
  const int u1 = std::min(u0 + tile_, planes_.width);
  const int v1 = std::min(v0 + tile_, planes_.height);
  Depths& tile = tiles_[static_cast<std::size_t>(row) * columns_ + column];
  DepthInterval& whole = tile.band;
  const std::size_t first = cones_.size();
  for (int v = v0; v < v1; ++v) {
    for (int u = u0; u < u1; ++u) {
      if (planes_.at(u, v).distance == 0) continue;
      const Depths depths = pixel_depths(u, v);
      cones_.push_back({static_cast<float>(u), static_cast<float>(v), 1, depths.band});
      widen(whole, depths.band);
      tile.free_to = std::max(tile.free_to, depths.free_to);
    }
  }
  if (cones_.size() < first + 2) return;
  const DepthInterval& one = cones_[first].depths;
  if (whole.far - whole.near > 2 * (one.far - one.near)) return;  // a depth edge: pixel by pixel
  cones_.resize(first);
  cones_.push_back({static_cast<float>(u0 + u1 - 1) / 2, static_cast<float>(v0 + v1 - 1) / 2,
                    static_cast<float>(tile_), whole});
}

std::vector<BlockKey> DepthBand::blocks(const Pose& world_from_camera) const {
  if (cones_.empty()) return {};
  constexpr float kPerBlock = 1.0F / kBlockEdge;
  const Eigen::Matrix3f rotation = world_from_camera.rotation_matrix().cast<float>() * kPerBlock;
  const Vector3f origin = (world_from_camera.translation() / (voxel_ * kBlockEdge)).cast<float>();
  const auto fx = static_cast<float>(camera_.fx);
  const auto fy = static_cast<float>(camera_.fy);
  const auto direction = [&](const Cone& cone) -> Array3f {
    const Vector3f ray((cone.u - static_cast<float>(camera_.cx)) / fx,
                       (cone.v - static_cast<float>(camera_.cy)) / fy, 1);
    return (rotation * ray).array();
  };
  const float radius_per_depth = std::sqrt(0.5F) / std::min(fx, fy) * kPerBlock;

  Array3f low = origin.array();
  Array3f high = low;
  for (const Cone& cone : cones_) {
    const Array3f end = origin.array() + direction(cone) * cone.depths.far;
    const float radius = radius_per_depth * cone.pixels * cone.depths.far;
    low = low.min(end - radius);
    high = high.max(end + radius);
  }
  BlockSet found(floored(low), floored(high));
  for (const Cone& cone : cones_) {
    const float radius = radius_per_depth * cone.pixels * cone.depths.far;
    const Array3f ray = direction(cone);
    const float length = (cone.depths.far - cone.depths.near) * ray.matrix().norm();
    const int parts = std::max(1, static_cast<int>(std::ceil(2 * length)));  // half a block each
    const Array3f step = ray * ((cone.depths.far - cone.depths.near) / static_cast<float>(parts));
    Array3f from = origin.array() + ray * cone.depths.near;
    for (int part = 0; part < parts; ++part) {
      const Array3f to = from + step;
      found.add_box(floored(from.min(to) - radius), floored(from.max(to) + radius));
      from = to;
    }
  }
  return found.sorted();
}

DepthBand::Reach DepthBand::reach(bool carve) const {
  Reach out{{}, columns_ + 2, rows_ + 2, kNothing};
  out.tiles.resize(static_cast<std::size_t>(out.columns) * out.rows, kNothing);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Depths& tile = tiles_[static_cast<std::size_t>(row) * columns_ + column];
      if (tile.band.near > tile.band.far) continue;
      const DepthInterval depths = carve ? DepthInterval{0, tile.free_to} : tile.band;
      widen(out.anywhere, depths);
      for (int i = 0; i < 9; ++i) {
        widen(out.tiles[static_cast<std::size_t>(row + i / 3) * out.columns + column + i % 3],
              depths);
      }
    }
  }
  return out;
}

void DepthBand::aim(FrameEvidence& frame, const Reach& reach, bool carve) const {
  const double tile = tile_;
  frame.carve = carve;
  frame.tiles = reach.tiles.data();
  frame.tile_columns = reach.columns;
  frame.tile_rows = reach.rows;
  frame.anywhere = reach.anywhere;
  frame.tile_fx = static_cast<float>(camera_.fx / tile);
  frame.tile_fy = static_cast<float>(camera_.fy / tile);
  frame.tile_cx = static_cast<float>((camera_.cx + 0.5) / tile + 1);
  frame.tile_cy = static_cast<float>((camera_.cy + 0.5) / tile + 1);
  // A voxel and the centre of its cube project within f r sqrt(1 + slope^2) / z of each other, r
  // half a cube's diagonal and the slope that of the voxel's ray; that must be one tile at most.
  const double radius = std::sqrt(0.75);
  const double slope_x = std::max(camera_.cx + 0.5, camera_.width - 0.5 - camera_.cx) / camera_.fx;
  const double slope_y = std::max(camera_.cy + 0.5, camera_.height - 0.5 - camera_.cy) / camera_.fy;
  frame.tiles_from = static_cast<float>(
      radius / tile *
      std::max(camera_.fx * std::hypot(1, slope_x), camera_.fy * std::hypot(1, slope_y)));
}

}  // namespace armsreach::mapping
