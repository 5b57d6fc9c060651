#include "vision/gesture/gesture_detector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "vision/gesture/hand_separation.hpp"

namespace armsreach::gesture {
namespace {

// The two best of the matches, by g; the second may be missing.
std::pair<const RingMatch*, const RingMatch*> best_two(const std::vector<RingMatch>& matches) {
  const RingMatch* first = nullptr;
  const RingMatch* second = nullptr;
  for (const RingMatch& match : matches) {
    if (first == nullptr || match.g > first->g) {
      second = first;
      first = &match;
    } else if (second == nullptr || match.g > second->g) {
      second = &match;
    }
  }
  return {first, second};
}

Eigen::Vector2d farthest_along(const std::vector<cv::Point>& outline, const Eigen::Vector2d& axis) {
  Eigen::Vector2d tip(outline[0].x, outline[0].y);
  for (const cv::Point& point : outline) {
    const Eigen::Vector2d at(point.x, point.y);
    if (at.dot(axis) > tip.dot(axis)) tip = at;
  }
  return tip;
}

// Where the wrist is cut, and so the hand's area, is uncertain: rings are tried at sizes around it.
constexpr std::array kSizes{0.95, 1.0, 1.05};

constexpr std::size_t kManyGestures = 8;

// Sampling at eight angles within a step averages out which side of a pixel's edge samples fall on.
constexpr std::array kPhases{-0.4375, -0.3125, -0.1875, -0.0625, 0.0625, 0.1875, 0.3125, 0.4375};

HandShape sized(const HandShape& shape, double size) {
  HandShape other = shape;
  other.area *= size * size;
  return other;
}

// What was looked at, and how like each gesture it is.
struct Reading {
  HandShape shape;  // of the size at which the best gesture matched
  std::vector<RingMatch> matches;
  double best = -1;  // g
};

Reading read_as(const RingMatcher& matcher, const HandShape& shape, Hands hand) {
  Reading reading{shape, {}};
  for (const double size : kSizes) {
    const HandShape at_size = sized(shape, size);
    const auto these =
        matcher.match(signature_of(at_size, matcher.set().layout), hand, straight_angle(shape));
    if (reading.matches.empty()) reading.matches = these;
    for (std::size_t i = 0; i < these.size(); ++i) {
      if (these[i].g > reading.matches[i].g) reading.matches[i] = these[i];
      if (these[i].g <= reading.best) continue;
      reading.best = these[i].g;
      reading.shape = at_size;
    }
  }
  return reading;
}

// A hand is a left or a right one for all gestures alike: a three in a mirror is like a seven.
Reading read(const RingMatcher& matcher, const HandShape& shape, Hands hands) {
  if (hands != Hands::both) return read_as(matcher, shape, hands);
  Reading learnt = read_as(matcher, shape, Hands::as_learnt);
  Reading other = read_as(matcher, shape, Hands::mirrored);
  return other.best > learnt.best ? other : learnt;
}

}  // namespace

GestureDetectorOptions options_for(const TemplateSet& set) {
  std::set<std::string> gestures;
  for (const GestureTemplate& one : set.templates) gestures.insert(one.gesture);
  GestureDetectorOptions options;
  if (gestures.size() >= kManyGestures) options.least_margin = 0.003;
  return options;
}

std::optional<double> straight_angle(const HandShape& shape) {
  if (!shape.to_arm) return std::nullopt;
  return std::atan2(-shape.to_arm->x(), shape.to_arm->y());
}

RingSignature signature_of(const HandShape& shape, const RingLayout& layout, double turn) {
  const Eigen::Vector2d center = (shape.center - shape.mask_origin) / shape.mask_scale;
  return sample_rings(shape.mask, center, shape.area / (shape.mask_scale * shape.mask_scale),
                      layout, turn);
}

GestureTemplate template_of(const std::string& gesture, const HandShape& shape,
                            const RingLayout& layout) {
  const auto straight = straight_angle(shape);
  return {gesture, signature_of(shape, layout, straight.value_or(0)), straight.has_value()};
}

double fine_angle(const RingMatcher& matcher, const HandShape& shape, const RingMatch& match) {
  const RingLayout& layout = matcher.set().layout;
  double sum = 0;
  for (const double phase : kPhases) {
    const double turn = phase * layout.step();
    const double angle = matcher.angle_of(signature_of(shape, layout, turn), match) + turn;
    sum += std::remainder(angle - match.angle, 2 * std::numbers::pi);
  }
  return std::remainder(match.angle + sum / kPhases.size(), 2 * std::numbers::pi);
}

std::vector<HandBlob> find_hands(const HandFinder& finder, const cv::Mat& skin,
                                 const cv::Mat& bgr) {
  auto blobs = finder.find(skin);
  if (blobs.empty() || blobs[0].plausible) return blobs;
  auto parted = finder.find(without_walls(bgr, skin));
  const double least = finder.options().least_area_alone * static_cast<double>(skin.total());
  const bool better = !parted.empty() && parted[0].plausible && parted[0].readings[0].area >= least;
  return better ? parted : blobs;
}

GestureDetector::GestureDetector(TemplateSet set, const GestureDetectorOptions& options)
    : options_(options), finder_(options.hands), matcher_(std::move(set)) {}

HandObservation GestureDetector::observe(const HandBlob& blob) const {
  Reading reading{blob.readings[0], {}};
  for (const HandShape& one : blob.readings) {
    Reading next = read(matcher_, one, options_.templates);
    if (next.best > reading.best) reading = std::move(next);
  }
  const HandShape& shape = reading.shape;
  const std::vector<RingMatch>& matches = reading.matches;
  HandObservation seen;
  seen.outline = blob.outline;
  seen.center = shape.center;
  seen.area = shape.area;
  for (std::size_t i = 0; i < matches.size(); ++i)
    seen.scores[matcher_.gestures()[i]] = matches[i].g;
  const auto [best, second] = best_two(matches);
  if (best != nullptr) {
    seen.score = best->g;
    seen.angle = fine_angle(matcher_, shape, *best);
    const double margin = second == nullptr ? 1 : best->g - second->g;
    if (blob.plausible && best->g >= options_.least_score && margin >= options_.least_margin)
      seen.gesture = matcher_.gestures()[static_cast<std::size_t>(best - matches.data())];
  }
  seen.fingertip = farthest_along(blob.outline, {std::sin(seen.angle), -std::cos(seen.angle)});
  return seen;
}

HandObservations GestureDetector::observe_all(const std::vector<HandBlob>& blobs) const {
  HandObservations hands;
  for (const HandBlob& blob : blobs) {
    hands.push_back(observe(blob));
    hands.back().hand = static_cast<int>(hands.size()) - 1;
  }
  return hands;
}

HandObservations GestureDetector::detect(const cv::Mat& skin) const {
  return observe_all(finder_.find(skin));
}

HandObservations GestureDetector::detect(const cv::Mat& skin, const cv::Mat& bgr) const {
  return observe_all(find_hands(finder_, skin, bgr));
}

}  // namespace armsreach::gesture
