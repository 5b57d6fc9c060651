#include "render/hand_annotations.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/annotations.hpp"

namespace armsreach::render {
namespace {

using Eigen::Vector2f;

constexpr float kWedgeFrom = 0.75F;  // sizes of the hand from its centre
constexpr float kWedgeTo = 2.6F;
constexpr float kOnBorder = 3;  // px of the image: an outline there is where the arm comes in

theme::Color faded(theme::Color color, int alpha) {
  color[3] = static_cast<std::uint8_t>(alpha);
  return color;
}

// From pixels of the scene's image to the picture. ImGui counts pixel edges.
class Map {
 public:
  Map(const View& view, const ImVec2& origin)
      : scale_(view.target_scale.cast<float>()),
        offset_(view.target_offset.cast<float>() + Vector2f(origin.x + 0.5F, origin.y + 0.5F)) {}

  Vector2f at(const Vector2f& pixel) const { return offset_ + scale_.cwiseProduct(pixel); }
  ImVec2 operator()(const Vector2f& pixel) const {
    const Vector2f point = at(pixel);
    return {point.x(), point.y()};
  }
  float length(float pixels) const { return scale_.x() * pixels; }

 private:
  Vector2f scale_;
  Vector2f offset_;
};

// Runs of the outline that are inside the image, so that its border is not drawn over.
std::vector<std::vector<ImVec2>> visible_runs(const Hand& hand, const View& view, const Map& map) {
  const auto on_border = [&view](const Vector2f& p) {
    return p.x() < kOnBorder || p.y() < kOnBorder ||
           p.x() > static_cast<float>(view.camera.width) - 1 - kOnBorder ||
           p.y() > static_cast<float>(view.camera.height) - 1 - kOnBorder;
  };
  const std::size_t count = hand.outline.size();
  std::size_t start = 0;  // on the border if anything is, so that no run is cut in two
  for (std::size_t i = 0; i < count; ++i) {
    if (on_border(hand.outline[i])) start = i;
  }
  std::vector<std::vector<ImVec2>> runs(1);
  for (std::size_t i = 0; i <= count; ++i) {
    const Vector2f& point = hand.outline[(start + i) % count];
    if (!on_border(point)) {
      runs.back().push_back(map(point));
    } else if (!runs.back().empty()) {
      runs.emplace_back();
    }
  }
  return runs;
}

void draw_outline(ImDrawList& list, const Hand& hand, const View& view, const Map& map) {
  if (hand.outline.size() < 3) return;
  const theme::Color color =
      hand.gesture.empty() ? faded(theme::kInk, 120) : faded(theme::kAccent, 215);
  for (const std::vector<ImVec2>& run : visible_runs(hand, view, map)) {
    if (run.size() < 2) continue;
    const int count = static_cast<int>(run.size());
    list.AddPolyline(run.data(), count, imgui_color({0, 0, 0, 70}), 0, 4);
    list.AddPolyline(run.data(), count, imgui_color(color), 0, 1.7F);
  }
}

void draw_rings(ImDrawList& list, const Hand& hand, const Map& map) {
  const ImVec2 centre = map(hand.center);
  for (const float radius : hand.rings) {
    list.AddCircle(centre, map.length(radius), imgui_color({0, 0, 0, 45}), 64, 2.5F);
    list.AddCircle(centre, map.length(radius), imgui_color(faded(theme::kInk, 105)), 64, 1);
  }
  if (hand.rings.empty()) return;
  const float reach = *std::max_element(hand.rings.begin(), hand.rings.end());
  const Vector2f axis(std::sin(hand.angle), -std::cos(hand.angle));
  const Vector2f foot = hand.tip + axis.dot(hand.center - hand.tip) * axis;
  list.AddLine(map(foot), map(foot + reach * axis), imgui_color(faded(theme::kInk, 150)), 1);
}

// A beam that fades with distance, and an arrow along its middle.
void draw_wedge(ImDrawList& list, const Hand& hand, const Map& map) {
  const auto at = [&](float angle, float sizes) {
    const Vector2f along(std::sin(hand.angle + angle), -std::cos(hand.angle + angle));
    return map(hand.center + sizes * hand.size * along);
  };
  constexpr int kSteps = 16;
  const ImVec2 uv = ImGui::GetFontTexUvWhitePixel();
  const ImU32 near_color = imgui_color(faded(theme::kAccent, 120));
  const ImU32 far_color = imgui_color(faded(theme::kAccent, 0));
  list.PrimReserve(6 * kSteps, 2 * (kSteps + 1));
  const auto first = static_cast<ImDrawIdx>(list._VtxCurrentIdx);
  for (int i = 0; i < kSteps; ++i) {
    for (const int corner : {0, 1, 2, 1, 3, 2})
      list.PrimWriteIdx(static_cast<ImDrawIdx>(first + 2 * i + corner));
  }
  for (int i = 0; i <= kSteps; ++i) {
    const float angle = hand.wedge * (2 * static_cast<float>(i) / kSteps - 1);
    list.PrimWriteVtx(at(angle, kWedgeFrom), uv, near_color);
    list.PrimWriteVtx(at(angle, kWedgeTo), uv, far_color);
  }
  const float tip = kWedgeFrom + 0.45F * (kWedgeTo - kWedgeFrom);
  const ImVec2 arrow[] = {at(-0.1F, tip - 0.17F), at(0, tip), at(0.1F, tip - 0.17F)};
  for (const auto& [color, width] :
       {std::pair(imgui_color({0, 0, 0, 90}), 5.F), std::pair(imgui_color(theme::kAccent), 2.2F)}) {
    list.AddLine(at(0, kWedgeFrom), at(0, tip), color, width);
    list.AddPolyline(arrow, 3, color, 0, width);
  }
}

// Beside the hand at the height of its centre, on the right if there is room, else on the left; a
// hand that fills the image has it above, or where that is outside, over its palm.
void draw_gesture(ImDrawList& list, const Fonts& fonts, const Hand& hand, const View& view,
                  const Map& map) {
  if (hand.gesture.empty()) return;
  char text[96];
  std::snprintf(text, sizeof text, "%s  %.2f", hand.gesture.c_str(),
                static_cast<double>(hand.score));
  const ImVec2 size = pill_size(*fonts.text, text, true);
  const Rectangle image = image_rectangle(view);
  const float left_edge = map.at({0, 0}).x() + 8;
  const float right_edge = left_edge + static_cast<float>(image.width) - 16;
  const float aside = map.length(0.85F * hand.size) + 10;
  const ImVec2 centre = map(hand.center);
  const bool right = centre.x + aside + size.x < right_edge;
  const float left = centre.x - aside - size.x;
  if (right || left >= left_edge) {
    const float x = right ? centre.x + aside : left;
    draw_pill(list, *fonts.text, {x, centre.y - size.y / 2}, text, &theme::kAccent);
    return;
  }
  float top = map.at(hand.center).y();
  for (const Vector2f& point : hand.outline) top = std::min(top, map.at(point).y());
  const float highest = map.at({0, 0}).y() + 8;
  const float above = top - size.y - 24;  // clear of the cursor on the fingertip
  const float x = std::clamp(centre.x - size.x / 2, left_edge, right_edge - size.x);
  draw_pill(list, *fonts.text, {x, above >= highest ? above : centre.y - size.y / 2}, text,
            &theme::kAccent);
}

// Corner brackets and the name above.
void draw_mark(ImDrawList& list, const Fonts& fonts, const Mark& mark, const View& view,
               const Map& map) {
  const float pad = 5;
  const ImVec2 low = map(mark.corner);
  const ImVec2 high = map(mark.corner + mark.size);
  const float left = std::round(low.x - pad);
  const float top = std::round(low.y - pad);
  const float right = std::round(high.x + pad);
  const float bottom = std::round(high.y + pad);
  const float arm = std::clamp(0.22F * std::min(right - left, bottom - top), 5.F, 18.F);
  const theme::Color color = mark.highlighted ? theme::kAccent : faded(theme::kInk, 170);
  const auto bracket = [&](float x, float y, float dx, float dy) {
    const ImVec2 points[] = {{x + dx, y}, {x, y}, {x, y + dy}};
    list.AddPolyline(points, 3, imgui_color({0, 0, 0, 80}), 0, 4.5F);
    list.AddPolyline(points, 3, imgui_color(color), 0, mark.highlighted ? 2.5F : 1.5F);
  };
  bracket(left, top, arm, arm);
  bracket(right, top, -arm, arm);
  bracket(left, bottom, arm, -arm);
  bracket(right, bottom, -arm, -arm);
  const ImVec2 size = pill_size(*fonts.text, mark.text, mark.highlighted);
  const float highest = map.at({0, 0}).y() + 6;
  const Rectangle image = image_rectangle(view);
  const float rightmost = map.at({0, 0}).x() + static_cast<float>(image.width) - size.x - 6;
  const float y = top - size.y - 6 < highest ? bottom + 6 : top - size.y - 6;
  draw_pill(list, *fonts.text, {std::min(left, rightmost), y}, mark.text,
            mark.highlighted ? &theme::kAccent : nullptr);
}

bool drawable(const Hand& hand) {
  return hand.center.allFinite() && std::isfinite(hand.size) && std::isfinite(hand.angle);
}

}  // namespace

void draw_hands(ImDrawList& list, const Fonts& fonts, const Scene& scene, const View& view,
                const ImVec2& origin) {
  const Map map(view, origin);
  for (const Mark& mark : scene.marks) draw_mark(list, fonts, mark, view, map);
  for (const Hand& hand : scene.hands) {
    if (!drawable(hand)) continue;
    draw_rings(list, hand, map);
    draw_outline(list, hand, view, map);
    if (hand.wedge > 0) draw_wedge(list, hand, map);
    draw_gesture(list, fonts, hand, view, map);
  }
}

}  // namespace armsreach::render
