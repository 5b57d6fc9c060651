#include "devices/image_pairs.hpp"

#include <gtest/gtest.h>

namespace armsreach {
namespace {

constexpr Timestamp kMillisecond = 1'000'000;

TimedImage at(int milliseconds) { return {{}, milliseconds * kMillisecond, 0}; }

int difference(const std::optional<ImagePair>& pair) {
  if (!pair) return 999;
  return static_cast<int>((pair->color.time - pair->depth.time) / kMillisecond);
}

TEST(ImagePairs, ImagesWithinHalfAPeriodArePaired) {
  ImagePairs pairs(30);
  EXPECT_FALSE(pairs.add_depth(at(0)));
  EXPECT_EQ(difference(pairs.add_color(at(10))), 10);
  EXPECT_FALSE(pairs.add_color(at(40)));
  EXPECT_EQ(difference(pairs.add_depth(at(33))), 7);
  EXPECT_FALSE(pairs.add_depth(at(66)));
  EXPECT_FALSE(pairs.add_color(at(90)));  // 24 ms apart: not of one moment
}

TEST(ImagePairs, ALateStreamIsPairedAllTheSame) {
  ImagePairs pairs(30);
  EXPECT_FALSE(pairs.add_depth(at(0)));
  EXPECT_FALSE(pairs.add_depth(at(33)));
  EXPECT_FALSE(pairs.add_depth(at(66)));
  EXPECT_EQ(difference(pairs.add_color(at(30))), -3);
  EXPECT_FALSE(pairs.add_color(at(5)));  // what is older than a pair has been given up
  EXPECT_EQ(difference(pairs.add_color(at(60))), -6);
}

TEST(ImagePairs, TheNearestIsTaken) {
  ImagePairs pairs(30);
  for (const int time : {0, 8, 16, 24}) EXPECT_FALSE(pairs.add_color(at(time)));
  EXPECT_EQ(difference(pairs.add_depth(at(17))), -1);
  EXPECT_EQ(difference(pairs.add_depth(at(19))), 5);  // each is in one pair only
}

TEST(ImagePairs, AnAbsentPartnerCostsNoMemory) {
  ImagePairs pairs(30);
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(pairs.add_depth(at(33 * i)));
  EXPECT_FALSE(pairs.add_color(at(0)));  // long forgotten
}

}  // namespace
}  // namespace armsreach
