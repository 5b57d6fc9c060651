#include "render/panel_painter.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace armsreach::render {

Result<PanelPainter> PanelPainter::make(const Gl& gl) {
  auto program = Program::from_assets(gl, {"shaders/target.glsl", "shaders/panel.vert.glsl"},
                                      {"shaders/panel.frag.glsl"});
  if (!program) return program.error();
  PanelPainter painter;
  painter.gl_ = &gl;
  painter.program_ = *std::move(program);
  painter.array_ = VertexArray(gl);
  painter.vertices_ = Buffer(gl);
  painter.indices_ = Buffer(gl);
  painter.array_.bind();
  painter.vertices_.bind(GL_ARRAY_BUFFER);
  painter.indices_.bind(GL_ELEMENT_ARRAY_BUFFER);
  describe_vertices(gl, sizeof(ImDrawVert),
                    {{2, GL_FLOAT, false, offsetof(ImDrawVert, pos)},
                     {2, GL_FLOAT, false, offsetof(ImDrawVert, uv)},
                     {4, GL_UNSIGNED_BYTE, true, offsetof(ImDrawVert, col)}});
  return painter;
}

void PanelPainter::draw(const ImDrawData& data) const {
  const int width = static_cast<int>(data.DisplaySize.x);
  const int height = static_cast<int>(data.DisplaySize.y);
  if (width <= 0 || height <= 0) return;
  program_.use();
  program_.set("target_size", Eigen::Vector2f(data.DisplaySize.x, data.DisplaySize.y));
  program_.set("picture", 0);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->Enable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->Enable(GL_SCISSOR_TEST);
  array_.bind();
  vertices_.bind(GL_ARRAY_BUFFER);
  constexpr GLenum kIndexType = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    gl_->BufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data,
                    GL_STREAM_DRAW);
    gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data,
                    GL_STREAM_DRAW);
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const int x0 = std::max(0, static_cast<int>(command.ClipRect.x));
      const int y0 = std::max(0, static_cast<int>(command.ClipRect.y));
      const int x1 = std::min(width, static_cast<int>(command.ClipRect.z));
      const int y1 = std::min(height, static_cast<int>(command.ClipRect.w));
      if (x1 <= x0 || y1 <= y0 || command.ElemCount == 0) continue;
      gl_->Scissor(x0, y0, x1 - x0, y1 - y0);
      gl_->BindTexture(GL_TEXTURE_2D,
                       static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
      gl_->DrawElementsBaseVertex(
          GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), kIndexType,
          reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)),
          static_cast<GLint>(command.VtxOffset));
    }
  }
  gl_->Disable(GL_SCISSOR_TEST);
  gl_->Disable(GL_BLEND);
}

}  // namespace armsreach::render
