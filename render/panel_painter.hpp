// Draws ImGui's draw lists through a context's own function table, so that windows, EGL and OSMesa
// show the same panels. Textures are OpenGL names in ImTextureID.
#pragma once

#include <imgui/imgui.h>

#include "render/gl_objects.hpp"

namespace armsreach::render {

inline ImTextureID imgui_texture(const Texture& texture) {
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture.id()));
}

class PanelPainter {
 public:
  static Result<PanelPainter> make(const Gl& gl);
  // Over the bound framebuffer, which has the size of the draw data's display.
  void draw(const ImDrawData& data) const;

 private:
  const Gl* gl_ = nullptr;
  Program program_;
  VertexArray array_;
  Buffer vertices_;
  Buffer indices_;
};

}  // namespace armsreach::render
