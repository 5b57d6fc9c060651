// Draws wide smooth line segments given in the world, bent and clipped as the view demands.
// Premultiplied alpha.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "render/gl_objects.hpp"
#include "render/instanced_quads.hpp"
#include "render/theme.hpp"
#include "render/view.hpp"

namespace armsreach::render {

struct LineEnd {
  Eigen::Vector3f point_in_world;
  theme::Color color;
};

// Segments are pairs of ends.
class Lines {
 public:
  void segment(const Eigen::Vector3f& from, const Eigen::Vector3f& to, const theme::Color& color);
  // Fades in from nothing at the first point to the colour at the last.
  void fading_path(const std::vector<Eigen::Vector3f>& points, const theme::Color& color);
  const std::vector<LineEnd>& ends() const { return ends_; }

 private:
  std::vector<LineEnd> ends_;
};

class LinePainter {
 public:
  static Result<LinePainter> make(const Gl& gl);
  // Into the bound framebuffer; tests depth only where the caller has enabled it.
  void draw(const View& view, const Lines& lines, float width) const;

 private:
  Program program_;
  InstancedQuads segments_;
};

}  // namespace armsreach::render
