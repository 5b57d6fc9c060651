#include "vision/gesture/hand_separation.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "simulated_hand.hpp"

namespace armsreach::gesture {
namespace {

// A beige wall and a hand a little redder, both skin to a model; with the noise of a camera.
TEST(HandSeparation, AHandComesOffItsWall) {
  const cv::Mat hand = test::simulated_hand(sim::Gesture::open, {}, 0.28);
  cv::Mat bgr(hand.size(), CV_8UC3, cv::Scalar(110, 160, 190));
  bgr.setTo(cv::Scalar(125, 150, 205), hand);
  cv::Mat noise(hand.size(), CV_8UC3);
  cv::RNG random(3);
  random.fill(noise, cv::RNG::NORMAL, 128, 4);
  cv::addWeighted(bgr, 1, noise, 1, -128, bgr);
  const cv::Mat all(hand.size(), CV_8UC1, cv::Scalar(255));
  const cv::Mat kept = without_walls(bgr, all);
  const double both = cv::countNonZero(kept & hand);
  EXPECT_GT(both / cv::countNonZero(kept | hand), 0.9);
}

TEST(HandSeparation, AWallAloneLeavesNothing) {
  const cv::Mat wall(240, 320, CV_8UC3, cv::Scalar(110, 160, 190));
  const cv::Mat all(wall.size(), CV_8UC1, cv::Scalar(255));
  EXPECT_EQ(cv::countNonZero(without_walls(wall, all)), 0);
  EXPECT_EQ(cv::countNonZero(without_walls(wall, cv::Mat::zeros(wall.size(), CV_8UC1))), 0);
}

}  // namespace
}  // namespace armsreach::gesture
