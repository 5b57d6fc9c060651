#include "vision/registration/color_edges.hpp"

#include <gtest/gtest.h>

namespace armsreach {
namespace {

// Dark left of column 100, bright from there on: the edge is at x = 99.5.
cv::Mat step(int contrast) {
  cv::Mat image(120, 200, CV_8UC1, cv::Scalar(60));
  image.colRange(100, 200).setTo(60 + contrast);
  return image;
}

TEST(ColorEdges, StandOutWhereBrightnessJumpsAndAcrossItOnly) {
  const EdgeField field(color_edges(step(80)), 1.6);
  const float there = field.at(99.5F, 60, Across::columns);
  EXPECT_GT(there, 0.5F);
  EXPECT_NEAR(field.at(98, 60, Across::columns), field.at(101, 60, Across::columns), 1e-3F);
  EXPECT_GT(there, field.at(98, 60, Across::columns));
  EXPECT_LT(field.at(80, 60, Across::columns), 0.05F);
  EXPECT_LT(field.at(99.5F, 60, Across::rows), 0.05F);
}

TEST(ColorEdges, OfWeakContrastCountNearlyAsMuch) {
  const float strong = EdgeField(color_edges(step(160)), 1.6).at(99.5F, 60, Across::columns);
  const float weak = EdgeField(color_edges(step(40)), 1.6).at(99.5F, 60, Across::columns);
  EXPECT_GT(weak, 0.8F * strong);  // a quarter of the contrast
}

TEST(ColorEdges, BeyondTheImageTheFieldIsItsMean) {
  const EdgeField field(color_edges(step(80)), 1.6);
  const float outside = field.at(-5, 60, Across::columns);
  EXPECT_EQ(outside, field.at(60, 500, Across::rows));
  EXPECT_GT(outside, 0);
  EXPECT_LT(outside, 0.1F);
}

}  // namespace
}  // namespace armsreach
