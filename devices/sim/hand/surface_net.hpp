// Triangles around the inside of a signed distance field.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace armsreach::sim {

// Planes of a grid along each axis, increasing.
using GridPlanes = std::array<std::vector<float>, 3>;

struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
};

// One vertex in every cell that the surface passes, one quadrilateral across every edge of the
// grid that it cuts: closed where the field is positive all around the grid. `distance` changes by
// at most 1 per metre; where it says that no surface is near, cells are skipped. Source: Gibson,
// "Constrained elastic surface nets", MICCAI 1998.
TriangleMesh surface_net(const GridPlanes& planes,
                         const std::function<float(const Eigen::Vector3f&)>& distance);

// Halves every edge whose middle is wanted; stays closed.
TriangleMesh refined(const TriangleMesh& mesh,
                     const std::function<bool(const Eigen::Vector3f&)>& wanted);

}  // namespace armsreach::sim
