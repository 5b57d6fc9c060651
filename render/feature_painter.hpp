// Draws measured image features as their three-sigma ellipses, coloured by state. Premultiplied
// alpha.
#pragma once

#include <vector>

#include "render/gl_objects.hpp"
#include "render/instanced_quads.hpp"
#include "render/scene.hpp"
#include "render/view.hpp"

namespace armsreach::render {

class FeaturePainter {
 public:
  static Result<FeaturePainter> make(const Gl& gl);
  void draw(const View& view, const std::vector<Feature>& features) const;

 private:
  Program program_;
  InstancedQuads quads_;
};

}  // namespace armsreach::render
