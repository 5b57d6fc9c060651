#include "vision/relocalisation/matching.hpp"

#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/vision/relocalisation/painted_room.hpp"
#include "vision/relocalisation/view.hpp"

namespace armsreach::relocalisation {
namespace {

Descriptor random_descriptor(std::mt19937_64& random) {
  Descriptor descriptor;
  for (auto& value : descriptor) value = static_cast<std::uint8_t>(random() % 60);
  return descriptor;
}

// Far from each other, so that none is the same place as another.
Feature place(std::size_t i) { return {{0.02F * static_cast<float>(i), 0}, 1}; }

Features random_features(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Features features;
  for (int i = 0; i < count; ++i) features.push_back(place(i), random_descriptor(random));
  return features;
}

Features views(double x) {
  const test::PaintedRoom room(1);
  return view_of(*room.frame(test::registered_sensor(), test::at(x, 0)), 500)->features;
}

double distance(const Descriptor& a, const Descriptor& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - b[i], 2);
  return std::sqrt(sum);
}

TEST(Matching, CodesHaveAtMostHalfTheirBitsSet) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20; ++i) {
    const Code code = code_of(random_descriptor(random));
    EXPECT_LE(std::popcount(code[0]) + std::popcount(code[1]), 64);
  }
}

TEST(Matching, AFeatureIsMatchedWithItselfUnlessItsTwinStandsElsewhere) {
  Features known = random_features(40, 3);
  EXPECT_EQ(match_features(known, known, 0.8, 100).size(), 40U);
  known.push_back(place(100), known.descriptors[7]);
  const Features query = random_features(40, 3);
  EXPECT_EQ(match_features(query, known, 0.8, 100).size(), 39U);
  known.places.back() = known.places[7];  // the twin in the same place competes with nobody
  EXPECT_EQ(match_features(query, known, 0.8, 100).size(), 40U);
}

TEST(Matching, OnlyTheFirstOfTheQueryAreGlancedAt) {
  const Features known = random_features(40, 3);
  EXPECT_EQ(match_features(known, known, 0.8, 15).size(), 15U);
  EXPECT_TRUE(match_features(known, Features(), 0.8, 15).empty());
  EXPECT_TRUE(match_features(Features(), known, 0.8, 15).empty());
}

TEST(Matching, CodesLoseFewOfTheNearestDescriptors) {
  const Features query = views(0.1);
  const Features known = views(0);
  std::vector<int> nearest(query.size());
  for (std::size_t i = 0; i < query.size(); ++i) {
    double least = 1e9;
    for (std::size_t j = 0; j < known.size(); ++j) {
      const double found = distance(query.descriptors[i], known.descriptors[j]);
      if (found >= least) continue;
      least = found;
      nearest[i] = static_cast<int>(j);
    }
  }
  const std::vector<Match> matches = match_features(query, known, 0.8, query.size());
  ASSERT_GT(matches.size(), 100U);
  std::size_t same = 0;
  for (const Match& match : matches) same += nearest[match.query] == match.known;
  EXPECT_GT(same, matches.size() * 95 / 100);
}

TEST(Matching, ExpectedFeaturesAreFoundWhereTheyAreExpectedOnly) {
  const Features known = random_features(10, 3);
  std::vector<Eigen::Vector2d> expected;
  for (const Feature& feature : known.places) expected.push_back(feature.ray.cast<double>());
  expected[2].x() += 1;
  expected[3].x() = std::nan("");
  const auto matches = match_expected(known, known, expected, 0.01);
  ASSERT_EQ(matches.size(), 8U);
  for (const Match& match : matches) EXPECT_EQ(match.query, match.known);
}

}  // namespace
}  // namespace armsreach::relocalisation
