#include "vision/gesture/hand_shape.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "simulated_hand.hpp"

namespace armsreach::gesture {
namespace {

using sim::Gesture;
using test::simulated_hand;

TEST(HandFinder, AForearmChangesLittle) {
  for (const Gesture gesture : {Gesture::open, Gesture::point, Gesture::fist}) {
    const auto cut_out = HandFinder().find(simulated_hand(gesture, {}, 0.01)).at(0);
    const auto with_arm = HandFinder().find(simulated_hand(gesture, {}, 0.28)).at(0);
    ASSERT_EQ(with_arm.readings.size(), 1U);
    const HandShape& hand = with_arm.readings[0];
    ASSERT_TRUE(hand.to_arm.has_value());
    EXPECT_GT(hand.to_arm->y(), 0.9);  // it comes from below
    // A tenth of a hand's length: where exactly a hand ends is a matter of taste.
    const double tenth = 0.1 * 0.69 * test::kHandImage;
    EXPECT_LT((hand.center - cut_out.readings[0].center).norm(), tenth) << name(gesture);
    EXPECT_NEAR(hand.area / cut_out.readings[0].area, 1, 0.25) << name(gesture);
    EXPECT_TRUE(with_arm.plausible);
  }
}

TEST(HandFinder, ASleevedArmIsCutAtTheWristToo) {
  // The arm ends inside the image; its end is nearer to the border than the hand.
  sim::HandView view;
  view.distance = 1.0;
  const auto blob = HandFinder().find(simulated_hand(Gesture::fist, view, 0.13)).at(0);
  const HandShape& hand = blob.readings.at(0);
  ASSERT_TRUE(hand.to_arm.has_value());
  EXPECT_GT(hand.to_arm->y(), 0.9);
  EXPECT_LT(hand.area, 0.75 * cv::contourArea(blob.outline));
}

TEST(HandFinder, WallsAreNoHands) {
  cv::Mat wall(240, 320, CV_8UC1, cv::Scalar(255));
  cv::rectangle(wall, {100, 60, 50, 50}, 0, cv::FILLED);
  EXPECT_FALSE(HandFinder().find(wall).at(0).plausible);
  EXPECT_TRUE(HandFinder().find(cv::Mat::zeros(240, 320, CV_8UC1)).empty());
  EXPECT_TRUE(HandFinder().find(cv::Mat()).empty());
}

// Cut out so tightly that it touches the border in a point; an arm that comes in there is broader.
TEST(HandFinder, AHandThatIsCutOutTightlyMayFillTheImage) {
  cv::Mat touching(200, 200, CV_8UC1, cv::Scalar(0));
  cv::circle(touching, {88, 100}, 88, 255, cv::FILLED);
  EXPECT_TRUE(HandFinder().find(touching).at(0).plausible);
  cv::Mat entering = touching.clone();
  cv::rectangle(entering, {0, 60, 100, 80}, 255, cv::FILLED);
  EXPECT_FALSE(HandFinder().find(entering).at(0).plausible);
}

TEST(HandFinder, TwoHandsTheLargerFirst) {
  sim::HandView near_one, far_one;
  near_one.distance = 0.8;
  far_one.distance = 1.1;
  cv::Mat both;
  cv::hconcat(simulated_hand(Gesture::open, far_one), simulated_hand(Gesture::fist, near_one),
              both);
  const auto blobs = HandFinder().find(both);
  ASSERT_EQ(blobs.size(), 2U);
  EXPECT_GT(blobs[0].readings[0].area, blobs[1].readings[0].area);
}

TEST(HandFinder, AHandMayFillTheSmallestImages) {
  for (int side = 1; side <= 4; ++side)
    EXPECT_NO_THROW(HandFinder().find(cv::Mat(side, side, CV_8UC1, cv::Scalar(255))));
}

}  // namespace
}  // namespace armsreach::gesture
