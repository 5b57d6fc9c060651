// Where everything lies on the operator's picture.
#pragma once

#include <array>

#include "render/view.hpp"

namespace armsreach::render {

struct Desk {
  Rectangle header;
  Rectangle map;
  std::array<Rectangle, 3> sides;  // top, front, side view
  Rectangle live;
  Rectangle panel;
};

// The map takes what the live view leaves; the live view has the video's shape.
Desk desk_for(int width, int height, double video_aspect);

}  // namespace armsreach::render
