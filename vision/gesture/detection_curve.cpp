#include "vision/gesture/detection_curve.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace armsreach::gesture {

std::vector<CurvePoint> detection_curve(std::vector<double> there, std::vector<double> not_there) {
  if (there.empty() || not_there.empty()) return {};
  std::sort(there.begin(), there.end(), std::greater<>());
  std::sort(not_there.begin(), not_there.end(), std::greater<>());
  const auto rate = [](std::size_t count, const std::vector<double>& of) {
    return static_cast<double>(count) / static_cast<double>(of.size());
  };
  std::vector<CurvePoint> curve{{std::max(there[0], not_there[0]) + 1, 0, 0}};
  std::size_t hits = 0, false_hits = 0;
  while (hits < there.size() || false_hits < not_there.size()) {
    const double next = hits == there.size() ? not_there[false_hits]
                        : false_hits == not_there.size()
                            ? there[hits]
                            : std::max(there[hits], not_there[false_hits]);
    while (hits < there.size() && there[hits] >= next) ++hits;
    while (false_hits < not_there.size() && not_there[false_hits] >= next) ++false_hits;
    curve.push_back({next, rate(false_hits, not_there), rate(hits, there)});
  }
  return curve;
}

double area_under(const std::vector<CurvePoint>& curve) {
  double area = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double width = curve[i].false_rate - curve[i - 1].false_rate;
    area += 0.5 * width * (curve[i].true_rate + curve[i - 1].true_rate);
  }
  return area;
}

double equal_error(const std::vector<CurvePoint>& curve) {
  double best = 1, rate = 1;
  for (const CurvePoint& point : curve) {
    const double missed = 1 - point.true_rate;
    if (std::abs(missed - point.false_rate) >= best) continue;
    best = std::abs(missed - point.false_rate);
    rate = 0.5 * (missed + point.false_rate);
  }
  return rate;
}

}  // namespace armsreach::gesture
