#include "vision/gesture/gesture_detector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "vision/gesture/cast_shadow.hpp"
#include "vision/gesture/hand_separation.hpp"
#include "vision/gesture/pointing_finger.hpp"

namespace armsreach::gesture {
namespace {

double likeness_of(const RingMatch& match, const GestureDetectorOptions& options) {
  return options.several_nearest ? match.likeness : match.g;
}

// What was looked at, and how like each gesture it is.
struct Reading {
  HandShape shape;                         // of the size at which the best gesture matched
  std::vector<RingMatch> matches;          // each at the size that suits it best
  std::vector<RingMatch> matches_at_size;  // of `shape`
  double best = -1;                        // likeness
};

// A gesture, and by how much it is likelier than every other.
struct Likeliest {
  std::size_t gesture = 0;
  double likeness = -1;
  double margin = 1;
};

Likeliest likeliest_of(const std::vector<RingMatch>& matches,
                       const GestureDetectorOptions& options) {
  Likeliest first;
  double second = -1;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const double likeness = likeness_of(matches[i], options);
    if (likeness > first.likeness) {
      second = first.likeness;
      first = {i, likeness, 1};
    } else {
      second = std::max(second, likeness);
    }
  }
  if (matches.size() > 1) first.margin = first.likeness - second;
  return first;
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

double solidity_of(const HandShape& shape) {
  std::vector<cv::Point> pixels, hull;
  cv::findNonZero(shape.mask, pixels);
  if (pixels.empty()) return 1;
  cv::convexHull(pixels, hull);
  return static_cast<double>(pixels.size()) / std::max(1.0, cv::contourArea(hull));
}

// Gestures that are about as like a disc as a blob without fingers is.
std::vector<bool> plain_gestures(const RingMatcher& matcher) {
  constexpr double kPlain = 0.89;  // mean g against a disc
  const TemplateSet& set = matcher.set();
  const double disc_radius = 1 / std::sqrt(std::numbers::pi);
  RingSignature disc;
  for (int ring = 0; ring < set.layout.rings(); ++ring)
    if (double{set.layout.radii[static_cast<std::size_t>(ring)]} < disc_radius)
      for (int angle = 0; angle < set.layout.samples; ++angle) disc.set(ring, angle);
  std::vector<bool> plain;
  for (const std::string& gesture : matcher.gestures()) {
    double sum = 0;
    int count = 0;
    for (const GestureTemplate& one : set.templates) {
      if (one.gesture != gesture) continue;
      sum += similarity(one.signature, disc, 0, set.layout);
      ++count;
    }
    plain.push_back(sum > kPlain * count);
  }
  return plain;
}

double most_evidence(const HandObservations& hands) {
  double most = std::numeric_limits<double>::lowest();
  for (const HandObservation& hand : hands) most = std::max(most, hand.evidence);
  return most;
}

// Sampling at eight angles within a step averages out which side of a pixel's edge samples fall on.
constexpr std::array kPhases{-0.4375, -0.3125, -0.1875, -0.0625, 0.0625, 0.1875, 0.3125, 0.4375};

// The direction of a shape's longest extent, rad, up to half a turn.
double long_axis(const HandShape& shape) {
  const cv::Moments m = cv::moments(shape.mask, true);
  return 0.5 * std::atan2(2 * m.mu11, m.mu20 - m.mu02);
}

HandShape sized(const HandShape& shape, double size) {
  HandShape other = shape;
  other.area *= size * size;
  return other;
}

Reading read_as(const RingMatcher& matcher, const HandShape& shape, Hands hand,
                const GestureDetectorOptions& options) {
  Reading reading{shape, {}, {}};
  for (const double size : options.sizes) {
    const HandShape at_size = sized(shape, size);
    const auto these =
        matcher.match(signature_of(at_size, matcher.set().layout), hand, straight_angle(shape));
    if (reading.matches.empty()) reading.matches = these;
    for (std::size_t i = 0; i < these.size(); ++i) {
      const double likeness = likeness_of(these[i], options);
      if (likeness > likeness_of(reading.matches[i], options)) reading.matches[i] = these[i];
      if (likeness <= reading.best) continue;
      reading.best = likeness;
      reading.shape = at_size;
      reading.matches_at_size = these;
    }
  }
  return reading;
}

// A hand is a left or a right one for all gestures alike: a three in a mirror is like a seven. (Of
// a bank, hands that look like both are the likelier ones.)
Reading read(const RingMatcher& matcher, const HandShape& shape,
             const GestureDetectorOptions& options) {
  if (options.templates != Hands::both || options.several_nearest)
    return read_as(matcher, shape, options.templates, options);
  Reading learnt = read_as(matcher, shape, Hands::as_learnt, options);
  Reading other = read_as(matcher, shape, Hands::mirrored, options);
  return other.best > learnt.best ? other : learnt;
}

}  // namespace

GestureDetectorOptions options_for(const TemplateSet& set, std::optional<TextureModel> texture) {
  constexpr std::size_t kManyGestures = 8;
  constexpr std::size_t kManyExamples = 20;  // of each
  std::set<std::string> gestures;
  for (const GestureTemplate& one : set.templates) gestures.insert(one.gesture);
  const bool many_examples = set.templates.size() >= kManyExamples * gestures.size();
  const bool numerals = gestures.size() >= kManyGestures;
  GestureDetectorOptions options;
  options.texture = std::move(texture);
  options.several_nearest = many_examples;
  if (numerals || !many_examples) options.sizes = {0.95, 1.0, 1.05};
  if (!many_examples) {
    options.least_score = 0.85;
    options.least_margin = numerals ? 0.003 : 0.01;
    options.least_log_odds = -2;  // of an example or two, which are less alike: only the worst
  } else if (numerals) {
    options.least_score = 0.9;
    options.least_margin = 0.002;
    options.least_log_odds = -0.25;  // weighed by other gestures
  } else {
    options.least_score = 0.8;
    options.least_margin = 0;
    options.least_log_odds = 0;
  }
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

double fine_angle(const RingMatcher& matcher, const HandShape& shape, const RingMatch& match,
                  double turn) {
  const RingLayout& layout = matcher.set().layout;
  double sum = 0;
  for (const double phase : kPhases) {
    const double more = phase * layout.step();
    const double angle = matcher.angle_of(signature_of(shape, layout, turn + more), match) + more;
    sum += std::remainder(angle - match.angle, 2 * std::numbers::pi);
  }
  return std::remainder(turn + match.angle + sum / kPhases.size(), 2 * std::numbers::pi);
}

double own_angle(const RingMatcher& matcher, const HandShape& shape, std::size_t gesture,
                 bool mirrored) {
  const double turn = long_axis(shape);
  auto straight = straight_angle(shape);
  if (straight) *straight -= turn;
  const auto matches = matcher.match(signature_of(shape, matcher.set().layout, turn),
                                     mirrored ? Hands::mirrored : Hands::as_learnt, straight);
  return fine_angle(matcher, shape, matches[gesture], turn);
}

bool any_told(const HandObservations& hands) {
  return std::any_of(hands.begin(), hands.end(),
                     [](const HandObservation& hand) { return hand.gesture.has_value(); });
}

HandObservations likelier(HandObservations one, HandObservations other) {
  if (any_told(one) != any_told(other)) return any_told(one) ? std::move(one) : std::move(other);
  return most_evidence(other) > most_evidence(one) ? std::move(other) : std::move(one);
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
    : options_(options),
      finder_(options.hands),
      matcher_(std::move(set)),
      plain_(plain_gestures(matcher_)) {}

HandObservation GestureDetector::observe(const HandBlob& blob, const Segmentation& in) const {
  Reading reading{blob.readings[0], {}, {}};
  for (const HandShape& one : blob.readings) {
    Reading next = read(matcher_, one, options_);
    if (next.best > reading.best) reading = std::move(next);
  }
  HandObservation seen;
  seen.outline = blob.outline;
  seen.center = reading.shape.center;
  seen.area = reading.shape.area;
  for (std::size_t i = 0; i < reading.matches_at_size.size(); ++i)
    seen.scores[matcher_.gestures()[i]] = reading.matches_at_size[i].g;
  seen.fingertip = farthest_along(blob.outline, {0, -1});
  if (reading.matches.empty()) return seen;
  const Likeliest likeliest = likeliest_of(reading.matches, options_);
  const RingMatch& match = reading.matches[likeliest.gesture];
  seen.likeliest = matcher_.gestures()[likeliest.gesture];
  seen.score = match.g;
  seen.angle = own_angle(matcher_, reading.shape, likeliest.gesture, match.mirrored);
  if (seen.likeliest == "point") {
    const PointingFinger finger = pointing_finger(reading.shape, seen.angle);
    seen.angle = finger.angle;
    seen.fingertip = finger.tip;
  } else {
    seen.fingertip = farthest_along(blob.outline, {std::sin(seen.angle), -std::cos(seen.angle)});
  }
  if (!blob.plausible) return seen;
  seen.evidence =
      log_odds({likeliest.likeness, likeliest.margin, contact_of(blob), solidity_of(reading.shape),
                seen.area / static_cast<double>(in.skin.total()), plain_[likeliest.gesture],
                in.parted, texture_of(seen, in.bgr)});
  if (is_told(seen, likeliest.margin)) seen.gesture = seen.likeliest;
  return seen;
}

double GestureDetector::texture_of(const HandObservation& seen, const cv::Mat& bgr) const {
  if (!options_.texture || bgr.empty()) return 0;
  return options_.texture->log_odds(texture_features(bgr, seen));
}

bool GestureDetector::is_told(const HandObservation& seen, double margin) const {
  if (seen.score < options_.least_score || margin < options_.least_margin) return false;
  return !options_.least_log_odds || seen.evidence >= *options_.least_log_odds;
}

HandObservations GestureDetector::detect_in(const Segmentation& segmentation) const {
  HandObservations hands;
  for (const HandBlob& blob : finder_.find(segmentation.skin)) {
    hands.push_back(observe(blob, segmentation));
    hands.back().hand = static_cast<int>(hands.size()) - 1;
  }
  return hands;
}

HandObservations GestureDetector::detect(const cv::Mat& skin) const {
  return detect_in({skin, {}, false});
}

HandObservations GestureDetector::detect(const cv::Mat& skin, const cv::Mat& bgr) const {
  const cv::Mat lit = without_shadow(bgr, skin);
  HandObservations hands = detect_in({lit, bgr, false});
  if (lit.data != skin.data) hands = likelier(std::move(hands), detect_in({skin, bgr, false}));
  if (hands.empty() || any_told(hands)) return hands;
  return likelier(std::move(hands), detect_in({without_walls(bgr, lit), bgr, true}));
}

HandObservations GestureDetector::detect(const std::vector<cv::Mat>& skins,
                                         const cv::Mat& bgr) const {
  HandObservations hands;
  for (std::size_t i = 0; i < skins.size() && !any_told(hands); ++i) {
    HandObservations others = detect(skins[i], bgr);
    if (i == 0 || any_told(others)) hands = std::move(others);
  }
  return hands;
}

}  // namespace armsreach::gesture
