// The panels' library (Dear ImGui) set up for this program: its context, our fonts and theme, our
// input, and drawing. One per renderer.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <imgui/imgui.h>

#include "render/input.hpp"
#include "render/panel_painter.hpp"
#include "render/theme.hpp"

namespace armsreach::render {

inline ImU32 imgui_color(const theme::Color& c) { return IM_COL32(c[0], c[1], c[2], c[3]); }
inline ImVec4 imgui_color4(const theme::Color& c) {
  return ImGui::ColorConvertU32ToFloat4(imgui_color(c));
}

// Inter for text and JetBrains Mono for figures; the library's own font where they are missing.
struct Fonts {
  ImFont* text = nullptr;
  ImFont* strong = nullptr;
  ImFont* small = nullptr;
  ImFont* figures = nullptr;
};

class Ui {
 public:
  static Result<Ui> make(const Gl& gl);

  // Between these two, ImGui's calls make the panels of one picture.
  void begin(const InputState& input, int width, int height);
  void end_and_draw();  // over the bound framebuffer

  const Fonts& fonts() const { return fonts_; }
  // Fonts that were missing, with the package that has them.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct DestroyContext {
    void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
  };

  void load_fonts(const Gl& gl);

  std::unique_ptr<ImGuiContext, DestroyContext> context_;
  PanelPainter painter_;
  Texture atlas_;
  Fonts fonts_;
  std::vector<std::string> notes_;
};

}  // namespace armsreach::render
