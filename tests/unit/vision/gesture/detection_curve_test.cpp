#include "vision/gesture/detection_curve.hpp"

#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

TEST(DetectionCurve, ApartAlikeAndReversed) {
  EXPECT_DOUBLE_EQ(area_under(detection_curve({0.9, 0.8}, {0.1, 0.2})), 1);
  EXPECT_DOUBLE_EQ(area_under(detection_curve({0.5}, {0.5})), 0.5);
  EXPECT_DOUBLE_EQ(area_under(detection_curve({0.1}, {0.9})), 0);
  EXPECT_TRUE(detection_curve({}, {0.5}).empty());
}

TEST(DetectionCurve, EqualErrorCountsBothKindsOfMistakes) {
  // At 0.5: one of four is missed, one of four falsely found.
  const auto curve = detection_curve({0.9, 0.8, 0.7, 0.2}, {0.6, 0.3, 0.1, 0.0});
  EXPECT_DOUBLE_EQ(equal_error(curve), 0.25);
  EXPECT_DOUBLE_EQ(equal_error(detection_curve({0.9, 0.8}, {0.1, 0.2})), 0);
}

}  // namespace
}  // namespace armsreach::gesture
