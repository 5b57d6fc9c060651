#include "render/instanced_quads.hpp"

namespace armsreach::render {

InstancedQuads::InstancedQuads(const Gl& gl, std::size_t stride,
                               const std::vector<InstanceAttribute>& attributes)
    : gl_(&gl), stride_(stride), array_(gl), instances_(gl) {
  array_.bind();
  instances_.bind(GL_ARRAY_BUFFER);
  for (GLuint index = 0; index < attributes.size(); ++index) {
    const InstanceAttribute& attribute = attributes[index];
    gl.EnableVertexAttribArray(index);
    gl.VertexAttribPointer(index, attribute.size, attribute.type,
                           attribute.normalised ? GL_TRUE : GL_FALSE, static_cast<GLsizei>(stride),
                           reinterpret_cast<const void*>(attribute.offset));
    gl.VertexAttribDivisor(index, 1);
  }
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
