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
  painter.program_ = *std::move(program);
  std::vector<VertexAttribute> attributes;
  for (const std::size_t start : {std::size_t{0}, sizeof(LineEnd)}) {
    attributes.push_back({3, GL_FLOAT, false, start + offsetof(LineEnd, point_in_world)});
    attributes.push_back({4, GL_UNSIGNED_BYTE, true, start + offsetof(LineEnd, color)});
  }
  painter.segments_ = InstancedQuads(gl, 2 * sizeof(LineEnd), attributes);
  return painter;
}

void LinePainter::draw(const View& view, const Lines& lines, float width) const {
  const auto& ends = lines.ends();
  if (ends.empty()) return;
  program_.use();
  set_view(program_, view);
  program_.set("width", width);
  segments_.draw(ends.data(), ends.size() / 2);
}

}  // namespace armsreach::render
