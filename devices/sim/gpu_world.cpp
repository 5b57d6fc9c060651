#include "devices/sim/gpu_world.hpp"

namespace armsreach::sim {

GpuWorld::GpuWorld(const render::Gl& gl, const WorldMesh& mesh)
    : gl_(&gl), parts_(mesh.parts), array_(gl), vertices_(gl), indices_(gl) {
  array_.bind();
  vertices_.bind(GL_ARRAY_BUFFER);
  gl.BufferData(GL_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(WorldVertex)),
                mesh.vertices.data(), GL_STATIC_DRAW);
  indices_.bind(GL_ELEMENT_ARRAY_BUFFER);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
                mesh.indices.data(), GL_STATIC_DRAW);
  render::describe_vertices(gl, sizeof(WorldVertex),
                            {{3, GL_FLOAT, false, offsetof(WorldVertex, position)},
                             {3, GL_FLOAT, false, offsetof(WorldVertex, normal)},
                             {2, GL_FLOAT, false, offsetof(WorldVertex, texture)},
                             {2, GL_FLOAT, false, offsetof(WorldVertex, light)}});
}

void GpuWorld::draw(std::size_t part) const {
  const MeshRange& range = parts_[part];
  gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(range.first * sizeof(std::uint32_t)));
}

}  // namespace armsreach::sim
