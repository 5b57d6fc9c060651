// The mapped surface as triangles: the points of surface.hpp joined across every edge between two
// voxels that the surface cuts (the faces of Gibson's surface nets). Open where the map ends.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vision/mapping/surface.hpp"
#include "vision/mapping/voxel_grid.hpp"

namespace armsreach::mapping {

using Triangle = std::array<std::uint32_t, 3>;  // vertices, counter-clockwise from the free side

struct SurfaceMesh {
  std::vector<SurfacePoint> vertices;  // block by block, in the order of their keys
  std::vector<Triangle> triangles;
};

SurfaceMesh surface_mesh(const VoxelGrid& grid);
// The vertices alone.
SurfaceMesh surface_cloud(const VoxelGrid& grid);

double area(const SurfaceMesh& mesh);  // m^2

}  // namespace armsreach::mapping
