#include "vision/registration/color_hypothesis.hpp"

#include <gtest/gtest.h>

#include "tests/support/synthetic_room.hpp"

namespace armsreach {
namespace {

const Camera kAssumed = *test::synthetic_sensor()->depth_camera;
const ColorHypothesis kSome{-4, 1, -0.5, 3, 0.5};

TEST(ColorHypothesis, AnotherBaselineLeavesOneDepthInPlace) {
  const ColorHypothesis other = with_baseline(kSome, -2, kAssumed, 1.5);
  EXPECT_EQ(other[3], -2);
  EXPECT_LT(displacement(kSome, other, kAssumed, {{0.3, -0.2, 1.5}, {-0.6, 0.4, 1.5}}), 1e-9);
  EXPECT_GT(displacement(kSome, other, kAssumed, {{0.1, 0, 0.5}}), 10);  // px
}

TEST(ColorHypothesis, ABaselineToEitherSideIsLikelierThanNone) {
  const auto of_baseline = [](double units) {
    return improbability(ColorHypothesis::Unit(3) * units);
  };
  EXPECT_EQ(of_baseline(3), of_baseline(-3));
  EXPECT_LT(of_baseline(3), 0.1);  // 24 mm
  EXPECT_GT(of_baseline(0), 20);
  EXPECT_NEAR(of_baseline(3.125 + usual_deviation()[3]), 1, 1e-9);
}

}  // namespace
}  // namespace armsreach
