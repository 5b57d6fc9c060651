// A world's triangles in the memory of a context.
#pragma once

#include <cstddef>
#include <vector>

#include "devices/sim/world_mesh.hpp"
#include "render/gl_objects.hpp"

namespace armsreach::sim {

class GpuWorld {
 public:
  GpuWorld() = default;
  GpuWorld(const render::Gl& gl, const WorldMesh& mesh);

  void bind() const { array_.bind(); }
  void draw(std::size_t part) const;  // of the bound world

 private:
  const render::Gl* gl_ = nullptr;
  std::vector<MeshRange> parts_;
  render::VertexArray array_;
  render::Buffer vertices_;
  render::Buffer indices_;
};

}  // namespace armsreach::sim
