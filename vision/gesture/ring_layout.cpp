#include "vision/gesture/ring_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace armsreach::gesture {
namespace {

constexpr float kOutermost = 1.3F;  // a spread hand's fingertips are 1.2 from its centroid

}  // namespace

double RingLayout::step() const { return 2 * std::numbers::pi / samples; }

int RingLayout::total_weight() const {
  return samples * std::accumulate(weights.begin(), weights.end(), 0);
}

bool RingLayout::valid() const {
  const auto fine = [](float radius) { return radius > 0 && radius < 10; };
  const auto weighs = [](int weight) { return weight > 0 && weight <= kMostWeight; };
  return !radii.empty() && rings() <= kMostRings && weights.size() == radii.size() &&
         samples >= 4 && samples <= kMostSamples && samples % 2 == 0 &&
         std::all_of(radii.begin(), radii.end(), fine) &&
         std::is_sorted(radii.begin(), radii.end()) &&
         std::all_of(weights.begin(), weights.end(), weighs);
}

RingLayout doubling_rings(int k) {
  RingLayout layout{{}, std::vector<std::uint8_t>(5, 1), 2 * k};
  for (int ring = 0; ring < 5; ++ring)
    layout.radii.push_back(kOutermost / static_cast<float>(16 >> ring));
  return layout;
}

RingLayout linear_rings(int k) {
  RingLayout layout{{}, {}, 2 * k};
  for (int tenths = 2; tenths <= 13; ++tenths) {
    layout.radii.push_back(static_cast<float>(tenths) / 10);
    layout.weights.push_back(static_cast<std::uint8_t>(tenths));
  }
  return layout;
}

RingLayout fine_rings(int k) {
  RingLayout layout{{}, {}, 2 * k};
  for (int step = 0; step < kMostRings; ++step) {
    const float radius = 0.3F + 0.075F * static_cast<float>(step);
    layout.radii.push_back(radius);
    layout.weights.push_back(static_cast<std::uint8_t>(std::lround(12 * radius)));
  }
  return layout;
}

}  // namespace armsreach::gesture
