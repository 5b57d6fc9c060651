#include "vision/mapping/mesh.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

namespace armsreach::mapping {
namespace {

using Offset = std::array<int, 3>;  // cells

// The vertices of one block, found by their cells.
class BlockVertices {
 public:
  BlockVertices(std::uint32_t first, std::vector<SurfaceCell> cells)
      : first_(first), cells_(std::move(cells)) {
    for (const SurfaceCell& cell : cells_) layers_[cell.z] |= bit(cell.x, cell.y);
  }

  const std::vector<SurfaceCell>& cells() const { return cells_; }  // x fastest, as their vertices
  std::uint32_t first() const { return first_; }

  std::optional<std::uint32_t> vertex(int x, int y, int z) const {
    const std::uint64_t here = bit(x, y);
    if ((layers_[z] & here) == 0) return std::nullopt;
    int before = std::popcount(layers_[z] & (here - 1));
    for (int lower = 0; lower < z; ++lower) before += std::popcount(layers_[lower]);
    return first_ + static_cast<std::uint32_t>(before);
  }

 private:
  static std::uint64_t bit(int x, int y) { return std::uint64_t{1} << (x + kBlockEdge * y); }

  std::uint32_t first_;
  std::vector<SurfaceCell> cells_;
  std::array<std::uint64_t, kBlockEdge> layers_{};  // the cells with a vertex, a word for each z
};

class MeshBuilder {
 public:
  explicit MeshBuilder(const VoxelGrid& grid) : keys_(grid.blocks.keys()) {
    blocks_.reserve(keys_.size());
    for (const BlockKey& key : keys_) {
      std::vector<SurfaceCell> cells;
      const std::vector<SurfacePoint> points = surface_points(grid, key, &cells);
      blocks_.emplace_back(static_cast<std::uint32_t>(mesh_.vertices.size()), std::move(cells));
      mesh_.vertices.insert(mesh_.vertices.end(), points.begin(), points.end());
    }
  }

  SurfaceMesh build() && {
    for (std::size_t block = 0; block < keys_.size(); ++block) {
      const Around around = blocks_around(keys_[block]);
      std::uint32_t vertex = blocks_[block].first();
      for (const SurfaceCell& cell : blocks_[block].cells()) add_faces(around, cell, vertex++);
    }
    return std::move(mesh_);
  }

 private:
  // A block (bits 0) and those before it: bit i, one back along axis i. Null where none is.
  using Around = std::array<const BlockVertices*, 8>;

  Around blocks_around(const BlockKey& key) const {
    Around around;
    for (int i = 0; i < 8; ++i) {
      const BlockKey before{key.x - (i & 1), key.y - (i >> 1 & 1), key.z - (i >> 2)};
      const auto found = std::lower_bound(keys_.begin(), keys_.end(), before);
      around[i] =
          found != keys_.end() && *found == before ? &blocks_[found - keys_.begin()] : nullptr;
    }
    return around;
  }

  // The vertex of the cell at `back` from another.
  static std::optional<std::uint32_t> vertex(const Around& around, const SurfaceCell& cell,
                                             const Offset& back) {
    const int x = cell.x - back[0];
    const int y = cell.y - back[1];
    const int z = cell.z - back[2];
    const BlockVertices* block = around[(x < 0 ? 1 : 0) + (y < 0 ? 2 : 0) + (z < 0 ? 4 : 0)];
    constexpr int kLast = kBlockEdge - 1;
    return block ? block->vertex(x & kLast, y & kLast, z & kLast) : std::nullopt;
  }

  // Of the three edges that leave the cell's first voxel.
  void add_faces(const Around& around, const SurfaceCell& cell, std::uint32_t own) {
    const bool free = (cell.free & 1) != 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (((cell.free >> (1 << axis) & 1) != 0) == free) continue;
      // The four cells around the edge, counter-clockwise about the axis.
      Offset first{};
      Offset second{};
      first[(axis + 1) % 3] = 1;
      second[(axis + 2) % 3] = 1;
      const Offset both{first[0] + second[0], first[1] + second[1], first[2] + second[2]};
      const auto b = vertex(around, cell, first);
      const auto c = vertex(around, cell, both);
      const auto d = vertex(around, cell, second);
      if (!b || !c || !d) continue;
      free ? add_quad(own, *d, *c, *b) : add_quad(own, *b, *c, *d);
    }
  }

  // Cut along its shorter diagonal.
  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    const auto apart = [this](std::uint32_t i, std::uint32_t j) {
      return (mesh_.vertices[i].point_in_world - mesh_.vertices[j].point_in_world).squaredNorm();
    };
    if (apart(a, c) <= apart(b, d)) {
      mesh_.triangles.insert(mesh_.triangles.end(), {{a, b, c}, {a, c, d}});
    } else {
      mesh_.triangles.insert(mesh_.triangles.end(), {{b, c, d}, {b, d, a}});
    }
  }

  std::vector<BlockKey> keys_;  // sorted
  std::vector<BlockVertices> blocks_;
  SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh surface_mesh(const VoxelGrid& grid) { return MeshBuilder(grid).build(); }

SurfaceMesh surface_cloud(const VoxelGrid& grid) {
  SurfaceMesh cloud;
  for (const BlockKey& key : grid.blocks.keys()) {
    const std::vector<SurfacePoint> points = surface_points(grid, key);
    cloud.vertices.insert(cloud.vertices.end(), points.begin(), points.end());
  }
  return cloud;
}

double area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3f& origin = mesh.vertices[t[0]].point_in_world;
    const Eigen::Vector3f a = mesh.vertices[t[1]].point_in_world - origin;
    const Eigen::Vector3f b = mesh.vertices[t[2]].point_in_world - origin;
    sum += static_cast<double>(a.cross(b).norm()) / 2;
  }
  return sum;
}

}  // namespace armsreach::mapping
