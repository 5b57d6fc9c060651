#include "vision/gesture/texture_training.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

// Noise in which hands have more of the first feature.
std::vector<TextureExample> noisy_examples(int hands, int others) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 0.1F);
  std::vector<TextureExample> examples;
  for (int i = 0; i < hands + others; ++i) {
    TextureExample one;
    one.hand = i < hands;
    for (float& value : one.features) value = noise(random);
    if (one.hand) one.features[0] += 0.5F;
    examples.push_back(one);
  }
  return examples;
}

TEST(TextureTraining, FindsWhatTellsHands) {
  const auto model = fitted_texture_model(noisy_examples(150, 150), "test");
  ASSERT_TRUE(model.ok());
  TextureFeatures first{};
  first[0] = 1;
  const TextureFeatures twin = mirrored(first);  // of the other hand
  for (std::size_t i = 1; i < kTextureSize; ++i) {
    if (twin[i] > 0) {
      EXPECT_NEAR(model->weights[i], model->weights[0], 1e-5);
    } else {
      ASSERT_GT(model->weights[0], 3 * std::abs(model->weights[i]));
    }
  }
  int right = 0;
  const auto examples = noisy_examples(150, 150);
  for (const TextureExample& one : examples)
    right += (model->log_odds(one.features) > 0) == one.hand;
  EXPECT_GT(right, 290);  // the two kinds are five deviations apart
}

// Ten times as many others, or each weighing ten times as much, say no more.
TEST(TextureTraining, BothKindsCountAlike) {
  auto examples = noisy_examples(40, 60);
  const auto model = fitted_texture_model(examples, "test");
  for (TextureExample& one : examples) one.weight = one.hand ? 1 : 10;
  const auto weighed = fitted_texture_model(examples, "test");
  std::reverse(examples.begin(), examples.end());
  const auto reversed = fitted_texture_model(examples, "test");
  ASSERT_TRUE(model.ok() && weighed.ok() && reversed.ok());
  EXPECT_NEAR(model->constant, weighed->constant, 1e-6);
  EXPECT_NEAR(model->constant, reversed->constant, 1e-6);
  for (std::size_t i = 0; i < kTextureSize; ++i) {
    ASSERT_NEAR(model->weights[i], weighed->weights[i], 1e-5);
    ASSERT_NEAR(model->weights[i], reversed->weights[i], 1e-5);
  }
}

// Kinds that a plane parts would have weights without end but for the ridge.
TEST(TextureTraining, WeightsStaySmallWhereTheKindsArePartedWholly) {
  const auto model = fitted_texture_model(noisy_examples(2, 2), "test");
  ASSERT_TRUE(model.ok());
  for (const float weight : model->weights) ASSERT_LT(std::abs(weight), 10);
}

TEST(TextureTraining, OneKindAloneIsRefused) {
  for (const auto& examples : {noisy_examples(5, 0), noisy_examples(0, 5), noisy_examples(0, 0)}) {
    const auto model = fitted_texture_model(examples, "learn hands");
    ASSERT_FALSE(model.ok());
    EXPECT_THAT(model.error().message(), testing::HasSubstr("learn hands"));
  }
}

}  // namespace
}  // namespace armsreach::gesture
