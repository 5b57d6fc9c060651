#include "vision/gesture/gesture_detector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "vision/gesture/cast_shadow.hpp"
#include "vision/gesture/hand_evidence.hpp"
#include "vision/gesture/hand_separation.hpp"

namespace armsreach::gesture {
namespace {

// The two likeliest of the matches; the second may be missing.
std::pair<const RingMatch*, const RingMatch*> best_two(const std::vector<RingMatch>& matches) {
  const RingMatch* first = nullptr;
  const RingMatch* second = nullptr;
  for (const RingMatch& match : matches) {
    if (first == nullptr || match.likeness > first->likeness) {
      second = first;
      first = &match;
    } else if (second == nullptr || match.likeness > second->likeness) {
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

double contact_of(const HandBlob& blob) {
  return blob.contact / std::sqrt(std::max(1.0, cv::contourArea(blob.outline)));
}

// Of the skin in an image, what is neither this blob nor another hand on its arm.
double clutter_around(std::size_t index, const std::vector<HandBlob>& blobs, const cv::Mat& skin) {
  double hands = 0;
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    const bool other_hand = blobs[i].plausible && blobs[i].readings[0].to_arm.has_value();
    if (i == index || other_hand) hands += cv::contourArea(blobs[i].outline);
  }
  return std::max(0.0, 1 - hands / std::max(1, cv::countNonZero(skin)));
}

// Sampling at eight angles within a step averages out which side of a pixel's edge samples fall on.
constexpr std::array kPhases{-0.4375, -0.3125, -0.1875, -0.0625, 0.0625, 0.1875, 0.3125, 0.4375};

}  // namespace

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
  const cv::Mat lit = without_shadow(bgr, skin);
  auto blobs = finder.find(lit);
  if (blobs.empty() || blobs[0].plausible) return blobs;
  auto parted = finder.find(without_walls(bgr, lit));
  const double least = finder.options().least_area_alone * static_cast<double>(skin.total());
  const bool better = !parted.empty() && parted[0].plausible && parted[0].readings[0].area >= least;
  return better ? parted : blobs;
}

GestureDetector::GestureDetector(TemplateSet set, const GestureDetectorOptions& options)
    : options_(options), finder_(options.hands), matcher_(std::move(set)) {}

HandObservation GestureDetector::observe(const HandBlob& blob, double clutter) const {
  const HandShape* shape = &blob.readings[0];
  std::vector<RingMatch> matches;
  for (const HandShape& reading : blob.readings) {
    auto these = matcher_.match(signature_of(reading, matcher_.set().layout), options_.templates,
                                straight_angle(reading));
    const RingMatch* best = best_two(these).first;
    if (best == nullptr) break;
    if (!matches.empty() && best->likeness <= best_two(matches).first->likeness) continue;
    matches = std::move(these);
    shape = &reading;
  }
  HandObservation seen;
  seen.outline = blob.outline;
  seen.center = shape->center;
  seen.area = shape->area;
  for (std::size_t i = 0; i < matches.size(); ++i)
    seen.scores[matcher_.gestures()[i]] = matches[i].g;
  const auto [best, second] = best_two(matches);
  if (best != nullptr) {
    seen.likeliest = matcher_.gestures()[static_cast<std::size_t>(best - matches.data())];
    seen.score = best->g;
    seen.angle = fine_angle(matcher_, *shape, *best);
    const double margin = second == nullptr ? 1 : best->likeness - second->likeness;
    const double odds = log_odds({best->likeness, margin, contact_of(blob), clutter});
    if (blob.plausible && best->g >= options_.least_score && margin >= options_.least_margin &&
        odds >= options_.least_log_odds)
      seen.gesture = seen.likeliest;
  }
  seen.fingertip = farthest_along(blob.outline, {std::sin(seen.angle), -std::cos(seen.angle)});
  return seen;
}

HandObservations GestureDetector::observe_all(const std::vector<HandBlob>& blobs,
                                              const cv::Mat& skin) const {
  HandObservations hands;
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    hands.push_back(observe(blobs[i], clutter_around(i, blobs, skin)));
    hands.back().hand = static_cast<int>(i);
  }
  return hands;
}

HandObservations GestureDetector::detect(const cv::Mat& skin) const {
  return observe_all(finder_.find(skin), skin);
}

HandObservations GestureDetector::detect(const cv::Mat& skin, const cv::Mat& bgr) const {
  return observe_all(find_hands(finder_, skin, bgr), skin);
}

}  // namespace armsreach::gesture
