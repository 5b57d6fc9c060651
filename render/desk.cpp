#include "render/desk.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::render {

Desk desk_for(int width, int height, double video_aspect) {
  const int gap = 10;
  const int header = 44;
  const int right = std::clamp(static_cast<int>(0.36 * width), 1, width);
  const int left = std::max(1, width - right - 3 * gap);
  const int body = std::max(1, height - header - gap);
  const int strip = std::max(1, static_cast<int>(0.27 * body));
  const int live = std::clamp(static_cast<int>(std::lround(right / video_aspect)), 1,
                              std::max(1, static_cast<int>(0.6 * body)));

  Desk desk;
  desk.header = {gap, 0, width - 2 * gap, header};
  desk.map = {gap, header, left, std::max(1, body - strip - gap)};
  const int third = std::max(1, (left - 2 * gap) / 3);
  for (int i = 0; i < 3; ++i)
    desk.sides[static_cast<std::size_t>(i)] = {gap + i * (third + gap),
                                               header + desk.map.height + gap, third, strip};
  desk.live = {2 * gap + left, header, right, live};
  desk.panel = {2 * gap + left, header + live + gap, right, std::max(1, body - live - gap)};
  return desk;
}

}  // namespace armsreach::render
