#include "vision/gesture/color_blobs.hpp"

#include <gtest/gtest.h>

#include "painted_skin.hpp"

namespace armsreach::gesture::test {
namespace {

const cv::Scalar kTable(40, 50, 45), kBlue(200, 110, 30), kRed(40, 40, 210);

ColorModel two_things() {
  ColorModel model;
  for (const auto& [name, color] : {std::pair{"blue mug", kBlue}, {"red ball", kRed}}) {
    cv::Mat picture = painted({200, 150}, kTable);
    cv::Mat mask = cv::Mat::zeros(picture.size(), CV_8UC1);
    mask(cv::Rect(80, 60, 40, 30)).setTo(255);
    painted(picture.size(), color).copyTo(picture, mask);
    ColorExamples examples;
    EXPECT_TRUE(add_examples(picture, mask, name, &examples).ok());
    model = *taught(model, name, examples, name);
  }
  return model;
}

cv::Mat scene(const cv::Size& size, const cv::Rect& mug, const cv::Rect& ball) {
  cv::Mat picture = painted(size, kTable);
  painted(mug.size(), kBlue).copyTo(picture(mug));
  painted(ball.size(), kRed).copyTo(picture(ball));
  return picture;
}

TEST(ColorBlobs, NamesAndPlacesThings) {
  ColorBlobFinder finder(two_things());
  for (const int scale : {1, 2, 3}) {
    const cv::Rect mug(60 * scale, 50 * scale, 40 * scale, 50 * scale);
    const cv::Rect ball(200 * scale, 120 * scale, 24 * scale, 24 * scale);
    const ColorBlobs blobs = finder.find(scene({320 * scale, 240 * scale}, mug, ball));
    ASSERT_EQ(blobs.size(), 2U);
    EXPECT_EQ(blobs[0].name, "blue mug");
    EXPECT_EQ(blobs[1].name, "red ball");
    // The box filter rounds corners off; an edge moves by no more than a pixel of the search.
    EXPECT_NEAR(blobs[0].box.x, mug.x, scale);
    EXPECT_NEAR(blobs[0].box.width, mug.width, 2 * scale);
    EXPECT_NEAR(blobs[0].area, mug.area(), 0.05 * mug.area());
    EXPECT_NEAR(blobs[1].center.x(), ball.x + (ball.width - 1) / 2.0, scale);
  }
}

TEST(ColorBlobs, NothingIsLookedForUnderTheHand) {
  ColorBlobFinder finder(two_things());
  const cv::Rect mug(60, 50, 40, 50), ball(200, 120, 24, 24);
  cv::Mat hidden = cv::Mat::zeros(240, 320, CV_8UC1);
  hidden(mug).setTo(255);
  const ColorBlobs blobs = finder.find(scene(hidden.size(), mug, ball), hidden);
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_EQ(blobs[0].name, "red ball");
}

HandObservation hand_at(int x, int y) {  // 60 px square
  HandObservation hand;
  hand.outline = {{x, y},           {x + 30, y},      {x + 59, y},
                  {x + 59, y + 30}, {x + 59, y + 59}, {x, y + 59}};
  hand.area = 3600;
  hand.center = {x + 29.5, y + 29.5};
  return hand;
}

ColorBlob thing(const std::string& name, int x) {
  return {name, {x, 100, 20, 20}, 400, {x + 9.5, 109.5}};
}

TEST(HeldThing, TheGapIsMeasuredInHands) {
  EXPECT_EQ(gap(thing("ball", 120), hand_at(100, 80)), 0);            // inside
  EXPECT_NEAR(gap(thing("ball", 189), hand_at(100, 80)), 0.5, 1e-9);  // 30 px from it
  EXPECT_GT(gap(thing("ball", 0), HandObservation{}), 1e9);
}

TEST(HeldThing, ChangesOnlyAfterSeveralFramesAndHoldsOnLonger) {
  HeldThing held({.take = 0.15, .release = 0.45, .frames = 3});
  const HandObservations hand{hand_at(100, 80)};
  EXPECT_FALSE(held.update({thing("ball", 162)}, hand));
  EXPECT_FALSE(held.update({thing("ball", 162)}, hand));
  EXPECT_FALSE(held.update({}, hand));  // a gap in what is seen starts the count again
  EXPECT_FALSE(held.update({thing("ball", 162)}, hand));
  EXPECT_FALSE(held.update({thing("ball", 162)}, hand));
  ASSERT_TRUE(held.update({thing("ball", 162)}, hand));
  EXPECT_EQ(held.update({thing("ball", 180)}, hand)->name, "ball");  // farther than it was taken
  EXPECT_EQ(held.update({thing("ball", 180)}, hand)->box.x, 180);
  // Another thing in the same hand does not take its place.
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(held.update({thing("ball", 162), thing("mug", 120)}, hand)->name, "ball");
  }
  EXPECT_TRUE(held.update({thing("ball", 260)}, hand));
  EXPECT_TRUE(held.update({thing("ball", 260)}, hand));
  EXPECT_FALSE(held.update({thing("ball", 260)}, hand));  // let go
}

TEST(HeldThing, EitherHandMayHoldIt) {
  HeldThing held({.take = 0.15, .release = 0.45, .frames = 1});
  EXPECT_TRUE(held.update({thing("ball", 420)}, {hand_at(100, 80), hand_at(400, 80)}));
}

TEST(HeldThing, WithoutAHandNothingIsHeld) {
  HeldThing held({.take = 0.15, .release = 0.45, .frames = 1});
  ASSERT_TRUE(held.update({thing("ball", 120)}, {hand_at(100, 80)}));
  EXPECT_FALSE(held.update({thing("ball", 120)}, {}));
}

}  // namespace
}  // namespace armsreach::gesture::test
