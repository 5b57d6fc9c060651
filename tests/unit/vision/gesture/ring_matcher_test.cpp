// The definition of g, the exactness of the search, and the angle.
#include "vision/gesture/ring_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "devices/sim/random.hpp"
#include "simulated_hand.hpp"
#include "vision/gesture/gesture_detector.hpp"

namespace armsreach::gesture {
namespace {

using sim::Gesture;
using test::simulated_hand;

constexpr double kDegree = std::numbers::pi / 180;

HandShape shape_of(const cv::Mat& mask) { return HandFinder().find(mask).at(0).readings.at(0); }

TemplateSet set_of(const RingLayout& layout, const std::vector<Gesture>& gestures) {
  TemplateSet set{layout, {}};
  for (const Gesture gesture : gestures) {
    set.templates.push_back(
        template_of(std::string(name(gesture)), shape_of(simulated_hand(gesture, {})), layout));
  }
  return set;
}

// The paper's definition, from the mask and nothing of the library's: samples in {+1, -1} on
// circles around the centroid, scaled by the root of the area, their products' mean.
double definition_of_g(const cv::Mat& seen, const cv::Mat& known, int shift,
                       const RingLayout& layout) {
  const auto sample = [&](const cv::Mat& mask, int ring, int angle) {
    const cv::Moments m = cv::moments(mask, true);
    const double r =
        std::sqrt(m.m00) * static_cast<double>(layout.radii[static_cast<std::size_t>(ring)]);
    const double theta = 2 * std::numbers::pi * angle / layout.samples;
    const cv::Point at(static_cast<int>(std::lround(m.m10 / m.m00 + r * std::cos(theta))),
                       static_cast<int>(std::lround(m.m01 / m.m00 + r * std::sin(theta))));
    return cv::Rect({0, 0}, mask.size()).contains(at) && mask.at<std::uint8_t>(at) != 0 ? 1 : -1;
  };
  double sum = 0, total = 0;
  for (int ring = 0; ring < layout.rings(); ++ring) {
    for (int angle = 0; angle < layout.samples; ++angle) {
      const double weight = layout.weights[static_cast<std::size_t>(ring)];
      sum += weight * sample(seen, ring, angle + shift) * sample(known, ring, angle);
      total += weight;
    }
  }
  return sum / total;
}

TEST(Rings, PaperLayoutHasNineHundredSamples) {
  const RingLayout layout = doubling_rings(90);
  EXPECT_EQ(layout.total_weight(), 900);
  for (std::size_t ring = 1; ring < layout.radii.size(); ++ring)
    EXPECT_FLOAT_EQ(layout.radii[ring], 2 * layout.radii[ring - 1]);
}

TEST(Rings, ScoreIsTheDefinitionRecomputedFromTheMasks) {
  const cv::Mat point = simulated_hand(Gesture::point, {});
  sim::HandView view;
  view.roll = 50 * kDegree;
  const cv::Mat seen = simulated_hand(Gesture::L, view);
  for (const RingLayout& layout : {doubling_rings(90), linear_rings(45)}) {
    const RingMatcher matcher(set_of(layout, {Gesture::point}));
    const RingMatch match =
        matcher.match(signature_of(shape_of(seen), layout), Hands::as_learnt).at(0);
    // A sample or two may fall on the other side of a pixel's edge for rounding.
    EXPECT_NEAR(match.g, definition_of_g(seen, point, match.shift, layout), 0.005);
  }
}

TEST(Rings, SearchIsExactAtEveryLevelOfInstructions) {
  sim::Random random(5);
  for (const RingLayout& layout : {doubling_rings(90), linear_rings(45), linear_rings(22)}) {
    TemplateSet set = set_of(layout, {Gesture::point, Gesture::L, Gesture::open, Gesture::fist});
    for (GestureTemplate one : std::vector(set.templates)) {
      for (int copy = 0; copy < 6; ++copy) {  // more than are kept
        for (int i = 0; i < 40; ++i)
          one.signature.set(random.below(layout.rings()), random.below(layout.samples));
        set.templates.push_back(one);
      }
    }
    const RingSignature seen =
        signature_of(shape_of(simulated_hand(Gesture::three, {0.3, 0.2, 1})), layout);
    const RingSignature mirror = mirrored(seen, layout);
    for (const Isa isa : {Isa::baseline, Isa::v3, Isa::v4}) {
      if (isa > best_isa()) continue;
      const RingMatcher matcher(set, isa);
      const auto matches = matcher.match(seen, Hands::both);
      for (std::size_t k = 0; k < matches.size(); ++k) {
        std::vector<double> scores;  // of its templates
        for (const GestureTemplate& one : set.templates) {
          if (one.gesture != matcher.gestures()[k]) continue;
          double best = -1;
          for (int shift = 0; shift < layout.samples; ++shift) {
            best = std::max({best, similarity(seen, one.signature, shift, layout),
                             similarity(mirror, one.signature, shift, layout)});
          }
          scores.push_back(best);
        }
        std::sort(scores.rbegin(), scores.rend());
        EXPECT_DOUBLE_EQ(matches[k].g, scores[0]);
        const auto count = static_cast<std::ptrdiff_t>(std::min<std::size_t>(5, scores.size()));
        const double sum = std::accumulate(scores.begin(), scores.begin() + count, 0.0);
        EXPECT_NEAR(matches[k].likeness, sum / static_cast<double>(count), 1e-12);
      }
    }
  }
}

TEST(Rings, TurnedCopiesAgreeWithinHalfADegree) {
  const cv::Mat upright = simulated_hand(Gesture::point, {});
  const RingLayout layout = linear_rings();
  const RingMatcher matcher(set_of(layout, {Gesture::point}));
  for (int degrees = -180; degrees < 180; degrees += 7) {
    const cv::Point2f middle(0.5F * test::kHandImage, 0.5F * test::kHandImage);
    cv::Mat turned;  // OpenCV's angle is anticlockwise
    cv::warpAffine(upright, turned, cv::getRotationMatrix2D(middle, -degrees, 1), upright.size());
    const HandShape shape = shape_of(turned > 127);
    const auto match = matcher.match(signature_of(shape, layout), Hands::as_learnt).at(0);
    const double error =
        std::remainder(fine_angle(matcher, shape, match) - degrees * kDegree, 2 * std::numbers::pi);
    EXPECT_LT(std::abs(error) / kDegree, 0.5) << degrees;
  }
}

TEST(Rings, AMirroredHandIsFoundByItsMirrorImage) {
  sim::HandView view;
  view.roll = 25 * kDegree;
  cv::Mat other;
  cv::flip(simulated_hand(Gesture::L, view), other, 1);
  const RingMatcher matcher(set_of(linear_rings(), {Gesture::L}));
  const RingSignature seen = signature_of(shape_of(other), linear_rings());
  const RingMatch match = matcher.match(seen, Hands::both).at(0);
  EXPECT_TRUE(match.mirrored);
  EXPECT_NEAR(match.angle / kDegree, -25, 4);  // to a step
  EXPECT_LT(matcher.match(seen, Hands::as_learnt).at(0).g, match.g - 0.02);
}

TEST(Rings, AForearmLimitsHowAHandTurns) {
  TemplateSet set = set_of(linear_rings(), {Gesture::point});
  set.templates[0].upright = true;
  const RingMatcher matcher(set);
  sim::HandView upside_down;
  upside_down.roll = std::numbers::pi;
  const RingSignature seen =
      signature_of(shape_of(simulated_hand(Gesture::point, upside_down)), linear_rings());
  EXPECT_GT(matcher.match(seen, Hands::as_learnt).at(0).g, 0.95);
  EXPECT_GT(matcher.match(seen, Hands::as_learnt, 3.0).at(0).g, 0.95);
  EXPECT_LT(matcher.match(seen, Hands::as_learnt, 0.0).at(0).g, 0.9);
}

}  // namespace
}  // namespace armsreach::gesture
