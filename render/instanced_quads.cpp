#include "render/instanced_quads.hpp"

namespace armsreach::render {

InstancedQuads::InstancedQuads(const Gl& gl, std::size_t stride,
                               const std::vector<VertexAttribute>& attributes)
    : gl_(&gl), stride_(stride), array_(gl), instances_(gl) {
  array_.bind();
  instances_.bind(GL_ARRAY_BUFFER);
  describe_vertices(gl, stride, attributes);
  for (GLuint location = 0; location < attributes.size(); ++location)
    gl.VertexAttribDivisor(location, 1);
}

void InstancedQuads::draw(const void* instances, std::size_t count) const {
  array_.bind();
  instances_.bind(GL_ARRAY_BUFFER);
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * stride_), instances,
                  GL_STREAM_DRAW);
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
  gl_->Disable(GL_BLEND);
}

}  // namespace armsreach::render
