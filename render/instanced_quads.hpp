// One quad for each of many instances that a vertex shader places, blended over what is there with
// premultiplied alpha.
#pragma once

#include <cstddef>
#include <vector>

#include "render/gl_objects.hpp"

namespace armsreach::render {

class InstancedQuads {
 public:
  InstancedQuads() = default;
  // An instance has `stride` bytes.
  InstancedQuads(const Gl& gl, std::size_t stride, const std::vector<VertexAttribute>& attributes);
  // With the program in use.
  void draw(const void* instances, std::size_t count) const;

 private:
  const Gl* gl_ = nullptr;
  std::size_t stride_ = 0;
  VertexArray array_;
  Buffer instances_;
};

}  // namespace armsreach::render
