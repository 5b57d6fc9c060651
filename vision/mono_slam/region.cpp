#include "vision/mono_slam/region.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::mono_slam {

int Region::area() const {
  int sum = 0;
  for (const Span& span : spans) sum += std::max(0, span.end - span.begin);
  return sum;
}

Region ellipse(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance,
               double deviations) {
  Region out;
  // Beyond this there is no image; the shape no longer matters.
  constexpr double kFarthest = 4000;
  const double a = covariance(0, 0);
  const double b = covariance(0, 1);
  const double c = covariance(1, 1);
  const double tall = std::min(deviations * std::sqrt(c), kFarthest);
  out.top = static_cast<int>(std::ceil(centre.y() - tall));
  const int bottom = static_cast<int>(std::floor(centre.y() + tall));
  for (int y = out.top; y <= bottom; ++y) {
    // The ellipse on this line: mean and deviation of x given y.
    const double dy = y - centre.y();
    const double middle = centre.x() + b / c * dy;
    const double left_over = deviations * deviations - dy * dy / c;
    const double wide =
        std::min(std::sqrt(std::max(left_over, 0.0) * std::max(a - b * b / c, 0.0)), kFarthest);
    out.spans.push_back({static_cast<int>(std::ceil(middle - wide)),
                         static_cast<int>(std::floor(middle + wide)) + 1});
  }
  return out;
}

Region square(const Eigen::Vector2d& centre, int radius) {
  Region out;
  const int x = static_cast<int>(std::lround(centre.x()));
  out.top = static_cast<int>(std::lround(centre.y())) - radius;
  out.spans.assign(static_cast<std::size_t>(2 * radius + 1), {x - radius, x + radius + 1});
  return out;
}

Region everywhere(int width, int height) {
  Region out;
  out.spans.assign(static_cast<std::size_t>(height), {0, width});
  return out;
}

Region merged(const Region& a, const Region& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  Region out;
  out.top = std::min(a.top, b.top);
  const int bottom =
      std::max(a.top + static_cast<int>(a.spans.size()), b.top + static_cast<int>(b.spans.size()));
  out.spans.resize(static_cast<std::size_t>(bottom - out.top));
  for (const Region* part : {&a, &b}) {
    for (std::size_t i = 0; i < part->spans.size(); ++i) {
      const Region::Span& span = part->spans[i];
      Region::Span& to = out.spans[i + static_cast<std::size_t>(part->top - out.top)];
      if (span.end <= span.begin) continue;
      to = to.end <= to.begin
               ? span
               : Region::Span{std::min(to.begin, span.begin), std::max(to.end, span.end)};
    }
  }
  return out;
}

Region within(const Region& region, int width, int height, int border) {
  Region out;
  const int bottom = std::min(region.top + static_cast<int>(region.spans.size()), height - border);
  out.top = std::clamp(region.top, border, std::max(border, height - border));
  for (int y = out.top; y < bottom; ++y) {
    const Region::Span& span = region.spans[static_cast<std::size_t>(y - region.top)];
    out.spans.push_back({std::max(span.begin, border), std::min(span.end, width - border)});
  }
  return out;
}

Region halved(const Region& region) {
  Region out;
  out.top = static_cast<int>(std::floor(region.top / 2.0));
  for (std::size_t i = 0; i < region.spans.size(); ++i) {
    const int y = region.top + static_cast<int>(i);
    const auto row = static_cast<std::size_t>(static_cast<int>(std::floor(y / 2.0)) - out.top);
    const Region::Span& span = region.spans[i];
    if (out.spans.size() <= row) out.spans.resize(row + 1);
    if (span.end <= span.begin) continue;
    const Region::Span half{static_cast<int>(std::floor(span.begin / 2.0)),
                            static_cast<int>(std::floor((span.end - 1) / 2.0)) + 1};
    Region::Span& to = out.spans[row];
    to = to.end <= to.begin
             ? half
             : Region::Span{std::min(to.begin, half.begin), std::max(to.end, half.end)};
  }
  return out;
}

}  // namespace armsreach::mono_slam
