// What of a surface lies before the camera's near plane.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace armsreach::sim {

using TriangleIndices = std::array<std::uint32_t, 3>;

// A few triangles with vertices of their own.
struct ClippedTriangles {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> colors;  // empty where the surface has none
  std::vector<TriangleIndices> triangles;
};

// The parts in z >= near of those triangles that the plane cuts, turning the same way round.
ClippedTriangles cut_at_near_plane(std::span<const Eigen::Vector3f> positions,
                                   std::span<const Eigen::Vector3f> colors,
                                   std::span<const TriangleIndices> triangles, float near);

}  // namespace armsreach::sim
