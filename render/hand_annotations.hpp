// What is shown of the wearer's hands over the live view: outline, rings, gesture, where a grasp
// points to, and the things that are named near them.
#pragma once

#include <imgui/imgui.h>

#include "render/scene.hpp"
#include "render/ui.hpp"
#include "render/view.hpp"

namespace armsreach::render {

// `origin` is where the view's target lies on the picture.
void draw_hands(ImDrawList& list, const Fonts& fonts, const Scene& scene, const View& view,
                const ImVec2& origin);

}  // namespace armsreach::render
