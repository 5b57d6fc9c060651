// A world as triangles, and the light map's layout: every patch has a rectangle of texels in one
// atlas, and every texel a place in the world where its light is gathered.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/world.hpp"

namespace armsreach::sim {

struct WorldVertex {
  Eigen::Vector3f position;  // in the part's thing's frame
  Eigen::Vector3f normal;
  Eigen::Vector2f texture;  // in repeats of the material's pattern, v down
  Eigen::Vector2f light;    // in the atlas, 0..1
};

// In the world's frame, or in that of a thing that moves.
struct LightTexel {
  Eigen::Vector4f position;  // w = 1
  Eigen::Vector4f normal;    // w = 0; zero where no surface is
};

struct MeshRange {  // of the part with the same index
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

struct WorldMesh {
  std::vector<WorldVertex> vertices;
  std::vector<std::uint32_t> indices;  // three a triangle, counter-clockwise seen from outside
  std::vector<MeshRange> parts;
  int atlas_width = 0;
  int atlas_height = 0;
  std::vector<LightTexel> texels;  // row by row
  std::vector<int> texel_things;   // which thing each texel lies on; -1: none
};

WorldMesh mesh_of(const World& world);

}  // namespace armsreach::sim
