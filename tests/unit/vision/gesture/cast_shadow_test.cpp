// A hand before a wall of its own colour, with and without the shadow it casts there.
#include "vision/gesture/cast_shadow.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {
namespace {

const cv::Scalar kSkin(110, 140, 200);
const cv::Rect kHand(100, 60, 80, 120);
const cv::Rect kShadow(180, 80, 30, 120);  // beside it

struct Scene {
  cv::Mat bgr{240, 320, CV_8UC3, cv::Scalar(120, 60, 30)};
  cv::Mat skin{240, 320, CV_8UC1, cv::Scalar(0)};
  void add(const cv::Rect& where, double brightness) {
    bgr(where).setTo(kSkin * brightness);
    skin(where).setTo(255);
  }
};

TEST(CastShadow, IsTakenAwayAndTheHandStays) {
  Scene scene;
  scene.add(kHand, 1);
  scene.add(kShadow, 0.3);
  const cv::Mat lit = without_shadow(scene.bgr, scene.skin);
  // The median rounds the corners.
  EXPECT_GT(cv::countNonZero(lit(kHand)), 0.99 * kHand.area());
  EXPECT_LT(cv::countNonZero(lit(kShadow)), 0.01 * kShadow.area());
}

TEST(CastShadow, AHandsOwnShadingIsNoShadow) {
  Scene scene;
  scene.add(kHand, 1);
  scene.add(cv::Rect(kHand.x, kHand.y, kHand.width / 3, kHand.height), 0.7);
  const cv::Mat lit = without_shadow(scene.bgr, scene.skin);
  EXPECT_EQ(cv::countNonZero(lit != scene.skin), 0);
}

TEST(CastShadow, ADarkWallIsNotAShadow) {
  // More of the skin than the hand itself: what is bright may be the highlight.
  Scene scene;
  scene.add({0, 0, 320, 240}, 0.3);
  scene.add(kHand, 1);
  const cv::Mat lit = without_shadow(scene.bgr, scene.skin);
  EXPECT_EQ(cv::countNonZero(lit != scene.skin), 0);
}

TEST(CastShadow, NoSkinHasNone) {
  const Scene scene;
  EXPECT_EQ(cv::countNonZero(without_shadow(scene.bgr, scene.skin)), 0);
}

}  // namespace
}  // namespace armsreach::gesture
