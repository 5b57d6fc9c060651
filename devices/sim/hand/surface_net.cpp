#include "devices/sim/hand/surface_net.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armsreach::sim {
namespace {

using Eigen::Vector3f;
using Cell = std::array<int, 3>;

constexpr int kBlock = 6;  // grid points along a side of what is skipped at once
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class Grid {
 public:
  explicit Grid(const GridPlanes& planes) : planes_(planes) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      size_[axis] = static_cast<int>(planes[axis].size());
  }

  int size(std::size_t axis) const { return size_[axis]; }
  std::size_t count() const {
    return static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
           static_cast<std::size_t>(size_[2]);
  }
  std::size_t index(const Cell& c) const {
    return (static_cast<std::size_t>(c[2]) * static_cast<std::size_t>(size_[1]) +
            static_cast<std::size_t>(c[1])) *
               static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(c[0]);
  }
  Vector3f point(const Cell& c) const {
    return {planes_[0][static_cast<std::size_t>(c[0])], planes_[1][static_cast<std::size_t>(c[1])],
            planes_[2][static_cast<std::size_t>(c[2])]};
  }

  template <class Visit>
  void each(const Cell& from, const Cell& to, const Visit& visit) const {
    for (int z = from[2]; z < to[2]; ++z)
      for (int y = from[1]; y < to[1]; ++y)
        for (int x = from[0]; x < to[0]; ++x) visit(Cell{x, y, z});
  }

 private:
  const GridPlanes& planes_;
  Cell size_{};
};

Cell moved(Cell cell, std::size_t axis, int by) {
  cell[axis] += by;
  return cell;
}

// The field at all grid points. One look at a block's centre is enough where the surface is farther
// away than its corners.
std::vector<float> sampled(const Grid& grid,
                           const std::function<float(const Vector3f&)>& distance) {
  std::vector<float> values(grid.count());
  for (int z = 0; z < grid.size(2); z += kBlock) {
    for (int y = 0; y < grid.size(1); y += kBlock) {
      for (int x = 0; x < grid.size(0); x += kBlock) {
        const Cell from{x, y, z};
        const Cell to{std::min(x + kBlock, grid.size(0)), std::min(y + kBlock, grid.size(1)),
                      std::min(z + kBlock, grid.size(2))};
        const Vector3f low = grid.point(from);
        const Vector3f high = grid.point({to[0] - 1, to[1] - 1, to[2] - 1});
        const float centre = distance(0.5F * (low + high));
        const bool near = std::abs(centre) <= 0.55F * (high - low).norm();
        grid.each(from, to, [&](const Cell& c) {
          values[grid.index(c)] = near ? distance(grid.point(c)) : centre;
        });
      }
    }
  }
  return values;
}

// The mean of where the surface cuts the cell's edges; nothing where it does not.
bool crossing_mean(const Grid& grid, const std::vector<float>& values, const Cell& cell,
                   Vector3f& mean) {
  Vector3f sum = Vector3f::Zero();
  int count = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      const Cell a = moved(moved(cell, (axis + 1) % 3, corner & 1), (axis + 2) % 3, corner >> 1);
      const Cell b = moved(a, axis, 1);
      const float va = values[grid.index(a)];
      const float vb = values[grid.index(b)];
      if ((va < 0) == (vb < 0)) continue;
      sum += grid.point(a) + va / (va - vb) * (grid.point(b) - grid.point(a));
      ++count;
    }
  }
  if (count > 0) mean = sum / static_cast<float>(count);
  return count > 0;
}

// The quadrilateral's corners counter-clockwise; cut along its shorter diagonal.
void add_quad(const std::array<std::uint32_t, 4>& q, TriangleMesh& mesh) {
  const auto length = [&](std::size_t i, std::size_t j) {
    return (mesh.vertices[q[i]] - mesh.vertices[q[j]]).squaredNorm();
  };
  if (length(0, 2) <= length(1, 3)) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  } else {
    mesh.triangles.push_back({q[1], q[2], q[3]});
    mesh.triangles.push_back({q[1], q[3], q[0]});
  }
}

}  // namespace

TriangleMesh surface_net(const GridPlanes& planes,
                         const std::function<float(const Vector3f&)>& distance) {
  const Grid grid(planes);
  const std::vector<float> values = sampled(grid, distance);
  const Cell cells{grid.size(0) - 1, grid.size(1) - 1, grid.size(2) - 1};
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex_of(grid.count(), kNone);
  grid.each({0, 0, 0}, cells, [&](const Cell& cell) {
    Vector3f mean;
    if (!crossing_mean(grid, values, cell, mean)) return;
    vertex_of[grid.index(cell)] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(mean);
  });
  // Around an edge along `axis` lie four cells; seen against the axis they go round with it.
  grid.each({1, 1, 1}, cells, [&](const Cell& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool inside = values[grid.index(cell)] < 0;
      if (inside == (values[grid.index(moved(cell, axis, 1))] < 0)) continue;
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      const Cell low_u = moved(cell, u, -1);
      std::array<std::uint32_t, 4> quad{vertex_of[grid.index(moved(low_u, v, -1))],
                                        vertex_of[grid.index(moved(cell, v, -1))],
                                        vertex_of[grid.index(cell)], vertex_of[grid.index(low_u)]};
      if (!inside) std::swap(quad[1], quad[3]);
      add_quad(quad, mesh);
    }
  });
  return mesh;
}

}  // namespace armsreach::sim
