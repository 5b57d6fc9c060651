// Hands over time: identity, filtered gesture, cursor, direction and actions together.
#include "vision/gesture/gesture_inference.hpp"

#include <fstream>

#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

constexpr Timestamp kFrame = 33'333'333;

InferenceOptions shipped() {
  std::ifstream in(ARMSREACH_SOURCE_DIR "/assets/gestures/transitions.yaml");
  InferenceOptions options;
  options.table = *read_gesture_table(in, "transitions.yaml");
  return options;
}

HandObservation showing(const std::string& gesture, double x = 300) {
  HandObservation hand;
  if (!gesture.empty()) hand.gesture = gesture;
  hand.score = 0.9;
  hand.center = {x, 240};
  hand.fingertip = {x, 140};
  hand.area = 100 * 100;
  hand.angle = 0.4;
  return hand;
}

TEST(GestureInference, APointingHandHasACursorAndAGraspingOneADirection) {
  GestureInference inference(shipped());
  Gestures out;
  for (int i = 0; i < 10; ++i) out = inference.update({showing("point")}, i * kFrame);
  ASSERT_EQ(out.hands.size(), 1U);
  EXPECT_EQ(out.hands[0].gesture, "point");
  EXPECT_NEAR(out.hands[0].score, 0.9, 1e-12);
  ASSERT_TRUE(out.hands[0].cursor);
  EXPECT_EQ(*out.hands[0].cursor, Eigen::Vector2d(300, 140));
  EXPECT_FALSE(out.hands[0].direction);
  for (int i = 10; i < 25; ++i) out = inference.update({showing("grasp")}, i * kFrame);
  EXPECT_FALSE(out.hands[0].cursor);
  EXPECT_EQ(out.hands[0].direction, 0.4);
}

TEST(GestureInference, AGraspIsOverWhenAnotherGestureIsShown) {
  for (const std::string other : {"point", "L", "open", "fist"}) {
    GestureInference inference(shipped());
    Gestures out;
    for (int i = 0; i < 20; ++i) out = inference.update({showing("grasp")}, i * kFrame);
    ASSERT_TRUE(out.hands[0].direction);
    for (int i = 20; i < 40; ++i) out = inference.update({showing(other)}, i * kFrame);
    EXPECT_FALSE(out.hands[0].direction) << other;
    EXPECT_TRUE(out.actions.empty()) << other;
  }
}

TEST(GestureInference, ACursorStaysWhereAFrameTellsNothingAndGoesWithTheIndexFinger) {
  GestureInference inference(shipped());
  Gestures out;
  int frame = 0;
  const auto show = [&](const HandObservation& hand) {
    out = inference.update({hand}, frame++ * kFrame);
  };
  for (int i = 0; i < 15; ++i) show(showing("point"));
  HandObservation another = showing("");
  another.fingertip = {150, 330};  // of the thumb, say
  show(another);
  ASSERT_TRUE(out.hands[0].cursor);
  EXPECT_EQ(*out.hands[0].cursor, Eigen::Vector2d(300, 140));
  for (int i = 0; i < 5; ++i) show(another);  // most of the filter's window
  EXPECT_EQ(out.hands[0].state, "pointing");  // it may yet be an L
  EXPECT_EQ(out.hands[0].gesture, "");
  EXPECT_FALSE(out.hands[0].cursor);
}

TEST(GestureInference, ABlobIsAHandOnceItHasMadeAGestureForAWhile) {
  GestureInference inference(shipped());
  Gestures out;
  int frame = 0;
  const auto show = [&](const std::string& gesture, int frames) {
    for (int i = 0; i < frames; ++i) out = inference.update({showing(gesture)}, frame++ * kFrame);
    return out.hands[0].established;
  };
  EXPECT_FALSE(show("", 60));
  EXPECT_FALSE(show("point", 3));
  EXPECT_FALSE(show("", 30));
  EXPECT_TRUE(show("point", 12));
  EXPECT_TRUE(show("", 60));
  EXPECT_FALSE(show("", 150));  // a wall behind the hand that has gone
}

TEST(GestureInference, ASelectionHappensOnceAtTheCursorWithGesturesInBetween) {
  GestureInference inference(shipped());
  std::vector<HandAction> actions;
  int frame = 0;
  const auto show = [&](const std::string& gesture, int frames) {
    for (int i = 0; i < frames; ++i) {
      const Gestures out = inference.update({showing(gesture)}, frame++ * kFrame);
      actions.insert(actions.end(), out.actions.begin(), out.actions.end());
    }
  };
  show("point", 15);
  show("", 8);  // on the way from one to the other
  show("L", 20);
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_EQ(actions[0].action, Action::select);
  EXPECT_EQ(actions[0].pixel, Eigen::Vector2d(300, 140));
}

TEST(GestureInference, TwoHandsAreFollowedApart) {
  GestureInference inference(shipped());
  Gestures out;
  for (int i = 0; i < 10; ++i) {
    const HandObservation left = showing("point", 150);
    const HandObservation right = showing("fist", 500);
    out = inference.update(i % 2 ? HandObservations{right, left} : HandObservations{left, right},
                           i * kFrame);
  }
  ASSERT_EQ(out.hands.size(), 2U);
  EXPECT_EQ(out.hands[0].gesture, "point");
  EXPECT_EQ(out.hands[1].gesture, "fist");
  EXPECT_EQ(*midpoint(out.hands), Eigen::Vector2d(325, 240));
}

TEST(GestureInference, AHandThatWasAwayBeginsAnew) {
  GestureInference inference(shipped());
  for (int i = 0; i < 10; ++i) inference.update({showing("point")}, i * kFrame);
  for (int i = 10; i < 40; ++i) EXPECT_TRUE(inference.update({}, i * kFrame).hands.empty());
  const Gestures out = inference.update({showing("")}, 40 * kFrame);
  EXPECT_EQ(out.hands[0].id, 0);
  EXPECT_EQ(out.hands[0].state, "idle");
}

}  // namespace
}  // namespace armsreach::gesture
