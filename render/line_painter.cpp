#include "render/line_painter.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace armsreach::render {

void Lines::segment(const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                    const theme::Color& color) {
  ends_.push_back({from, color});
  ends_.push_back({to, color});
}

void Lines::fading_path(const std::vector<Eigen::Vector3f>& points, const theme::Color& color) {
  // More segments than this cannot be told apart on a screen.
  const std::size_t step = std::max<std::size_t>(1, points.size() / 200);
  const auto faded = [&](std::size_t i) {
    theme::Color result = color;
    const double age =
        static_cast<double>(points.size() - 1 - i) / static_cast<double>(points.size());
    result[3] = static_cast<std::uint8_t>(color[3] * (1 - 0.85 * age));
    return result;
  };
  for (std::size_t i = 0; i + 1 < points.size(); i += step) {
    const std::size_t j = std::min(i + step, points.size() - 1);
    ends_.push_back({points[i], faded(i)});
    ends_.push_back({points[j], faded(j)});
  }
}

Result<LinePainter> LinePainter::make(const Gl& gl) {
  auto program = Program::from_assets(
      gl, {"shaders/target.glsl", "shaders/view.glsl", "shaders/line.vert.glsl"},
      {"shaders/line.frag.glsl"});
  if (!program) return program.error();
  LinePainter painter;
  painter.gl_ = &gl;
  painter.program_ = *std::move(program);
  painter.array_ = VertexArray(gl);
  painter.segments_ = Buffer(gl);
  painter.array_.bind();
  painter.segments_.bind(GL_ARRAY_BUFFER);
  const auto attribute = [&gl](GLuint index, GLint size, GLenum type, GLboolean normalised,
                               std::size_t offset) {
    gl.EnableVertexAttribArray(index);
    gl.VertexAttribPointer(index, size, type, normalised, 2 * sizeof(LineEnd),
                           reinterpret_cast<const void*>(offset));
    gl.VertexAttribDivisor(index, 1);
  };
  for (GLuint end = 0; end < 2; ++end) {
    const std::size_t start = end * sizeof(LineEnd);
    attribute(2 * end, 3, GL_FLOAT, GL_FALSE, start + offsetof(LineEnd, point_in_world));
    attribute(2 * end + 1, 4, GL_UNSIGNED_BYTE, GL_TRUE, start + offsetof(LineEnd, color));
  }
  return painter;
}

void LinePainter::draw(const View& view, const Lines& lines, float width) const {
  const auto& ends = lines.ends();
  if (ends.empty()) return;
  program_.use();
  set_view(program_, view);
  program_.set("width", width);
  array_.bind();
  segments_.bind(GL_ARRAY_BUFFER);
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(ends.size() * sizeof(LineEnd)),
                  ends.data(), GL_STREAM_DRAW);
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(ends.size() / 2));
  gl_->Disable(GL_BLEND);
}

}  // namespace armsreach::render
