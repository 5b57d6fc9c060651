// The panels around the views, and what the person chose in them.
#pragma once

#include <string>

#include "render/scene.hpp"
#include "render/ui.hpp"
#include "render/view.hpp"

namespace armsreach::render {

// What stays chosen from one picture to the next.
struct Choices {
  std::string insert;  // mesh that the next click inserts; empty: select
  bool show_inliers = false;
};

// What was pressed in this picture.
struct Presses {
  bool delete_selected = false;
  bool wearer_layout = false;
};

// Wearer: a state pill where the camera is tracked, and the newest messages over the video, nothing
// else.
void draw_wearer_overlay(const Fonts& fonts, const Scene& scene, const Rectangle& picture);

// The newest three messages at the lower left of a view, the newest lowest.
void draw_messages(ImDrawList& list, const Fonts& fonts, const Scene& scene, const Rectangle& view);

// Operator: the bar above the views with the state and the main figures,
void draw_header(const Fonts& fonts, const Scene& scene, const Rectangle& place);
// and the panel with palette and stages.
Presses draw_side_panel(const Fonts& fonts, const Scene& scene, const Rectangle& place,
                        Choices& choices);

theme::Color state_color(const std::string& tracking_state);

}  // namespace armsreach::render
