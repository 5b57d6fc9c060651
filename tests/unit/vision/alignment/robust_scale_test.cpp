#include "vision/alignment/robust_scale.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

std::vector<float> normal_samples(double deviation, int count) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0, deviation);
  std::vector<float> samples(count);
  for (float& sample : samples) sample = static_cast<float>(normal(random));
  return samples;
}

TEST(RobustScale, IsTheStandardDeviationOfNormalSamplesAtAnyMagnitude) {
  RobustScale scale;
  for (const double deviation : {1e-5, 3e-3, 0.2, 40.0}) {
    // The median of 20000 samples is good to about 1 %, the histogram's bins to less.
    EXPECT_NEAR(scale(normal_samples(deviation, 20000), 1).scale / deviation, 1, 0.03);
  }
}

TEST(RobustScale, BearsOutliersAndUnknowns) {
  std::vector<float> samples = normal_samples(0.01, 20000);
  for (std::size_t i = 0; i < samples.size(); i += 5) samples[i] = 100;
  for (std::size_t i = 1; i < samples.size(); i += 5) {
    samples[i] = std::numeric_limits<float>::quiet_NaN();
  }
  RobustScale scale;
  const auto estimate = scale(samples, 1);
  EXPECT_EQ(estimate.count, 16000);
  // A quarter of the known samples is wild: the median moves to the 67th percentile of the rest.
  EXPECT_NEAR(estimate.scale, 1.4826 * 0.967 * 0.01, 5e-4);
}

TEST(RobustScale, OfNothingIsZero) {
  RobustScale scale;
  EXPECT_EQ(scale({}, 1).count, 0);
  const std::vector<float> unknown(10, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(scale(unknown, 1).scale, 0);
  EXPECT_NEAR(scale(std::vector<float>(10, 0.0F), 1).scale, 0, 1e-6);
}

TEST(RobustScale, LooksAtEveryNth) {
  RobustScale scale;
  EXPECT_EQ(scale(std::vector<float>(100, 1.0F), 7).count, 15);
}

}  // namespace
}  // namespace armsreach
