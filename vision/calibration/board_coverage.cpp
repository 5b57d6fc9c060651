#include "vision/calibration/board_coverage.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace armsreach::calibration {
namespace {

constexpr int kEnoughViews = 12;
constexpr double kNewView = 0.2;  // sum of differences to the nearest view that was taken

// Spans of place that a good set of views has: the board's middle need not reach the border, since
// its corners do.
constexpr double kSpanAcross = 0.5;
constexpr double kSpanDown = 0.45;
constexpr double kSpanSize = 0.25;
constexpr double kSpanTilt = 0.35;

double length(const cv::Point2f& a, const cv::Point2f& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

double shrinkage(double a, double b) { return 1 - std::min(a, b) / std::max(a, b); }

template <class Get>
std::pair<double, double> range(const std::vector<BoardPlace>& places, Get get) {
  double low = 1;
  double high = 0;
  for (const BoardPlace& place : places) {
    low = std::min(low, get(place));
    high = std::max(high, get(place));
  }
  return {low, high};
}

double share(std::pair<double, double> range, double wanted) {
  return std::clamp((range.second - range.first) / wanted, 0.0, 1.0);
}

}  // namespace

BoardPlace BoardCoverage::place_of(const Corners& corners) const {
  const auto last = static_cast<std::size_t>(board_.columns - 1);
  const cv::Point2f& a = corners.front();
  const cv::Point2f& b = corners[last];
  const cv::Point2f& c = corners.back();
  const cv::Point2f& d = corners[corners.size() - 1 - last];
  const std::vector<cv::Point2f> outline{a, b, c, d};
  const cv::Point2f middle = (a + b + c + d) * 0.25F;
  BoardPlace place;
  place.x = std::clamp(middle.x / static_cast<float>(image_.width), 0.0F, 1.0F);
  place.y = std::clamp(middle.y / static_cast<float>(image_.height), 0.0F, 1.0F);
  place.size = std::clamp(std::sqrt(cv::contourArea(outline) / image_.area()), 0.0, 1.0);
  // Opposite sides differ in length when one of them is farther away; all of a kind shrink against
  // the other kind when the board is turned far from a small camera angle.
  const double perspective =
      std::max(shrinkage(length(a, b), length(d, c)), shrinkage(length(a, d), length(b, c)));
  const double aspect = (length(a, b) + length(d, c)) * (board_.rows - 1) /
                        ((length(a, d) + length(b, c)) * (board_.columns - 1));
  place.tilt = std::min(1.0, 2 * std::max(perspective, shrinkage(aspect, 1)));
  return place;
}

bool BoardCoverage::adds(const Corners& corners) const {
  const BoardPlace place = place_of(corners);
  return std::none_of(places_.begin(), places_.end(), [&](const BoardPlace& known) {
    return std::abs(known.x - place.x) + std::abs(known.y - place.y) +
               std::abs(known.size - place.size) + std::abs(known.tilt - place.tilt) <
           kNewView;
  });
}

void BoardCoverage::take(const Corners& corners) { places_.push_back(place_of(corners)); }

std::array<double, 4> BoardCoverage::progress() const {
  if (places_.empty()) return {0, 0, 0, 0};
  return {share(range(places_, [](const auto& p) { return p.x; }), kSpanAcross),
          share(range(places_, [](const auto& p) { return p.y; }), kSpanDown),
          share(range(places_, [](const auto& p) { return p.size; }), kSpanSize),
          share(range(places_, [](const auto& p) { return p.tilt; }), kSpanTilt)};
}

bool BoardCoverage::complete() const {
  const auto shares = progress();
  return views() >= kEnoughViews &&
         std::all_of(shares.begin(), shares.end(), [](double share) { return share >= 1; });
}

std::string BoardCoverage::advice() const {
  if (complete()) return "";
  if (places_.empty()) return "show the whole board";
  const auto shares = progress();
  const auto worst = std::min_element(shares.begin(), shares.end()) - shares.begin();
  if (shares[static_cast<std::size_t>(worst)] >= 1) return "show it from a few more places";
  const auto [left, right] = range(places_, [](const auto& p) { return p.x; });
  const auto [top, bottom] = range(places_, [](const auto& p) { return p.y; });
  const auto [far, near] = range(places_, [](const auto& p) { return p.size; });
  switch (worst) {
    case 0:
      return left > 1 - right ? "move it to the left edge" : "move it to the right edge";
    case 1:
      return top > 1 - bottom ? "move it to the top edge" : "move it to the bottom edge";
    case 2:
      return near < 0.5 ? "bring it closer" : "take it farther away";
    default:
      return "tilt it, first to one side and then upwards";
  }
}

}  // namespace armsreach::calibration
