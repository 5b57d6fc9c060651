// Labels with leader lines, cursors and captions over the live view.
#pragma once

#include <imgui/imgui.h>

#include "render/scene.hpp"
#include "render/ui.hpp"
#include "render/view.hpp"

namespace armsreach::render {

// `origin` is where the view's target lies on the picture.
void draw_annotations(ImDrawList& list, const Fonts& fonts, const Scene& scene, const View& view,
                      const ImVec2& origin);

// A rounded dark pill with text, its upper left corner at `corner`; returns its size. With `dot`
// a coloured dot stands before the text.
ImVec2 draw_pill(ImDrawList& list, ImFont& font, const ImVec2& corner, const std::string& text,
                 const theme::Color* dot = nullptr);
// The text in as many lines as it takes for its pill to be no wider.
std::string wrapped(const ImFont& font, const std::string& text, float width);
ImVec2 pill_size(const ImFont& font, const std::string& text, bool with_dot = false);

}  // namespace armsreach::render
