#include "vision/gaze/point_predictor.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

using Eigen::Vector3d;

constexpr double kFrame = 1.0 / 30;
Timestamp at_frame(int i) { return timestamp_from_seconds(i * kFrame); }

TEST(PointPredictor, KnowsNothingBeforeTheFirstMeasurement) {
  EXPECT_FALSE(PointPredictor(PointNoise{}).at(0));
}

// A hand to and fro at up to 0.5 m/s, 0.5 m away; 150 ms ahead. Extrapolating its speed alone is
// off by up to a t^2 / 2 = 1.25 * 0.15^2 / 2 = 14 mm, standing still by 75 mm.
TEST(PointPredictor, PredictsAMovingHandThroughTheDelay) {
  PointPredictor predictor(PointNoise{0.006, 6, 0.3});
  const auto hand = [](double t) { return Vector3d(0.2 * std::sin(2.5 * t), 0, 0.5); };
  double worst = 0;
  for (int i = 0; i < 150; ++i) {
    predictor.observe(at_frame(i), hand(i * kFrame));
    if (i < 30) continue;
    const double later = i * kFrame + 0.15;
    worst = std::max(worst, (*predictor.at(timestamp_from_seconds(later)) - hand(later)).norm());
  }
  EXPECT_LT(worst, 0.010);
}

TEST(PointPredictor, OneStragglerIsIgnoredTwoAreANewPlace) {
  PointPredictor predictor(PointNoise{});
  for (int i = 0; i < 30; ++i) predictor.observe(at_frame(i), Vector3d(0, 0, 0.5));
  predictor.observe(at_frame(30), Vector3d(0.3, 0, 0.5));
  EXPECT_NEAR(predictor.at(at_frame(33))->x(), 0, 1e-3);
  predictor.observe(at_frame(31), Vector3d(0.301, 0, 0.5));
  EXPECT_NEAR(predictor.at(at_frame(34))->x(), 0.301, 1e-6)
      << "and it stands there: a leap is no speed";
}

TEST(PointPredictor, WithoutMeasurementsItStaysBeyondItsHorizon) {
  PointPredictor predictor(PointNoise{});
  for (int i = 0; i < 30; ++i) predictor.observe(at_frame(i), Vector3d(0.01 * i, 0, 0.5));
  const double last = 29 * kFrame;
  const Vector3d end = *predictor.at(timestamp_from_seconds(last + PointPredictor::kHorizon));
  EXPECT_EQ(*predictor.at(timestamp_from_seconds(last + 5)), end);
}

TEST(PointPredictor, MeasurementsOutOfOrderAreLeftOut) {
  PointPredictor predictor(PointNoise{});
  predictor.observe(at_frame(3), Vector3d(0, 0, 1));
  predictor.observe(at_frame(2), Vector3d(0.01, 0, 1));
  EXPECT_EQ(*predictor.at(at_frame(3)), Vector3d(0, 0, 1));
}

}  // namespace
}  // namespace armsreach
