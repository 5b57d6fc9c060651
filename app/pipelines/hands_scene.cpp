#include "app/pipelines/hands_scene.hpp"

#include <algorithm>
#include <cmath>

#include "vision/gesture/pointing.hpp"

namespace armsreach::app {
namespace {

constexpr float kOutlineStep = 4;  // px between points of a drawn outline
constexpr int kSmoothings = 2;     // of it, each the mean with the middle of its neighbours

// Points at equal distances along a closed outline, which has as many as there are pixels.
std::vector<Eigen::Vector2f> resampled(const std::vector<cv::Point>& outline) {
  std::vector<Eigen::Vector2f> points;
  float left = 0;  // px to the next point
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const cv::Point& a = outline[i];
    const cv::Point& b = outline[(i + 1) % outline.size()];
    const Eigen::Vector2f from(static_cast<float>(a.x), static_cast<float>(a.y));
    const Eigen::Vector2f to(static_cast<float>(b.x), static_cast<float>(b.y));
    const float length = (to - from).norm();
    while (left < length) {
      points.push_back(from + left / length * (to - from));
      left += kOutlineStep;
    }
    left -= length;
  }
  return points;
}

std::vector<Eigen::Vector2f> smooth_outline(const std::vector<cv::Point>& outline) {
  std::vector<Eigen::Vector2f> points = resampled(outline);
  const std::size_t count = points.size();
  if (count < 3) return {};
  for (int pass = 0; pass < kSmoothings; ++pass) {
    std::vector<Eigen::Vector2f> smoothed(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector2f neighbours = points[(i + count - 1) % count] + points[(i + 1) % count];
      smoothed[i] = 0.5F * points[i] + 0.25F * neighbours;
    }
    points = std::move(smoothed);
  }
  return points;
}

render::Hand scene_hand(const gesture::Hand& hand, const std::vector<double>& rings) {
  render::Hand out;
  out.outline = smooth_outline(hand.seen.outline);
  out.center = hand.seen.center.cast<float>();
  out.size = static_cast<float>(std::sqrt(hand.seen.area));
  out.angle = static_cast<float>(hand.seen.angle);
  out.gesture = hand.gesture;
  out.score = static_cast<float>(hand.score);
  out.tip = (hand.cursor ? hand.seen.fingertip : hand.seen.center).cast<float>();
  if (hand.direction) out.wedge = static_cast<float>(gesture::Wedge().half_angle);
  for (const double radius : rings) out.rings.push_back(static_cast<float>(radius) * out.size);
  return out;
}

}  // namespace

void add_hands(const HandsState& hands, render::Scene* scene) {
  for (const gesture::Hand& hand : hands.hands) {
    scene->hands.push_back(scene_hand(hand, hands.rings));
    if (hand.cursor)
      scene->cursors.push_back({hand.cursor->cast<float>(), hand.state == "selecting", ""});
  }
  for (std::size_t i = 0; i < hands.things.size(); ++i) {
    const bool highlighted = hands.highlighted == i;
    if (!highlighted && hands.held != i) continue;
    const gesture::ColorBlob& thing = hands.things[i];
    scene->marks.push_back(
        {thing.name,
         {static_cast<float>(thing.box.x), static_cast<float>(thing.box.y)},
         {static_cast<float>(thing.box.width), static_cast<float>(thing.box.height)},
         highlighted});
  }
}

}  // namespace armsreach::app
