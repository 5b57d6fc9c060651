#include "render/annotations.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/hand_annotations.hpp"

namespace armsreach::render {
namespace {

constexpr float kPadX = 10;  // px inside a pill
constexpr float kPadY = 5;
constexpr float kDot = 4;  // radius

struct Box {
  ImVec2 corner;
  ImVec2 size;
  bool overlaps(const Box& other) const {
    return corner.x < other.corner.x + other.size.x && other.corner.x < corner.x + size.x &&
           corner.y < other.corner.y + other.size.y && other.corner.y < corner.y + size.y;
  }
};

ImVec2 on_picture(const ImVec2& origin, const Eigen::Vector2d& target) {
  // ImGui counts pixel edges.
  return {origin.x + static_cast<float>(target.x()) + 0.5F,
          origin.y + static_cast<float>(target.y()) + 0.5F};
}

// Up and to the right of the point, pushed up past labels placed before, kept within the view.
Box place(const ImVec2& point, const ImVec2& size, const Box& view, const std::vector<Box>& taken) {
  Box box{{point.x + 22, point.y - 30 - size.y}, size};
  const auto keep_inside = [&] {
    box.corner.x =
        std::clamp(box.corner.x, view.corner.x + 6,
                   std::max(view.corner.x + 6, view.corner.x + view.size.x - size.x - 6));
    box.corner.y =
        std::clamp(box.corner.y, view.corner.y + 6,
                   std::max(view.corner.y + 6, view.corner.y + view.size.y - size.y - 6));
  };
  keep_inside();
  for (const Box& other : taken) {
    if (!box.overlaps(other)) continue;
    box.corner.y = other.corner.y - size.y - 5;
    keep_inside();
  }
  return box;
}

void draw_labels(ImDrawList& list, const Fonts& fonts, const Scene& scene, const View& view,
                 const ImVec2& origin) {
  const Box whole{origin,
                  {static_cast<float>(view.target_width), static_cast<float>(view.target_height)}};
  std::vector<Box> taken;
  for (const Label& label : scene.labels) {
    const auto target = project_to_target(view, label.point_in_world);
    if (!target || !view.camera.contains(camera_pixel_from_target(view, *target))) continue;
    const ImVec2 point = on_picture(origin, *target);
    const Box box = place(point, pill_size(*fonts.text, label.text), whole, taken);
    const ImVec2 joint{std::clamp(point.x, box.corner.x + 8, box.corner.x + box.size.x - 8),
                       point.y < box.corner.y ? box.corner.y : box.corner.y + box.size.y};
    list.AddLine(point, joint, imgui_color({255, 255, 255, 210}), 1.5F);
    list.AddCircleFilled(point, 4.5F, imgui_color({13, 16, 20, 220}));
    list.AddCircleFilled(point, 3, imgui_color(theme::kAccent));
    draw_pill(list, *fonts.text, box.corner, label.text);
    taken.push_back(box);
  }
}

void draw_cursors(ImDrawList& list, const Fonts& fonts, const Scene& scene, const View& view,
                  const ImVec2& origin) {
  for (const Cursor& cursor : scene.cursors) {
    if (!cursor.pixel.allFinite()) continue;
    const Eigen::Vector2d target =
        view.target_offset + view.target_scale.cwiseProduct(cursor.pixel.cast<double>());
    const ImVec2 centre = on_picture(origin, target);
    const float radius = cursor.pressed ? 8 : 13;
    list.AddCircle(centre, radius, imgui_color({0, 0, 0, 110}), 32, 4.5F);
    list.AddCircle(centre, radius, imgui_color(theme::kAccent), 32, 2);
    list.AddCircleFilled(centre, cursor.pressed ? 5.F : 2.5F,
                         imgui_color(cursor.pressed ? theme::kAccent : theme::kInk), 16);
    if (!cursor.caption.empty())
      draw_pill(list, *fonts.small, {centre.x + radius + 8, centre.y - 11}, cursor.caption);
  }
}

}  // namespace

ImVec2 pill_size(const ImFont& font, const std::string& text, bool with_dot) {
  const ImVec2 size = font.CalcTextSizeA(font.FontSize, 1e6F, 0, text.c_str());
  return {std::ceil(size.x) + 2 * kPadX + (with_dot ? 3.5F * kDot : 0), font.FontSize + 2 * kPadY};
}

ImVec2 draw_pill(ImDrawList& list, ImFont& font, const ImVec2& corner_wanted,
                 const std::string& text, const theme::Color* dot) {
  const ImVec2 size = pill_size(font, text, dot != nullptr);
  const ImVec2 corner{std::round(corner_wanted.x), std::round(corner_wanted.y)};  // sharp text
  list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, imgui_color(theme::kGlass),
                     std::min(theme::kRounding, size.y / 2));
  float x = corner.x + kPadX;
  if (dot) {
    list.AddCircleFilled({x + kDot, corner.y + size.y / 2}, kDot, imgui_color(*dot), 16);
    x += 3.5F * kDot;
  }
  list.AddText(&font, font.FontSize, {x, corner.y + kPadY}, imgui_color(theme::kInk), text.c_str());
  return size;
}

void draw_annotations(ImDrawList& list, const Fonts& fonts, const Scene& scene, const View& view,
                      const ImVec2& origin) {
  list.PushClipRect(origin, {origin.x + static_cast<float>(view.target_width),
                             origin.y + static_cast<float>(view.target_height)});
  draw_hands(list, fonts, scene, view, origin);
  if (scene.pose_known) draw_labels(list, fonts, scene, view, origin);
  draw_cursors(list, fonts, scene, view, origin);
  list.PopClipRect();
}

}  // namespace armsreach::render
