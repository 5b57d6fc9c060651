// The hands' and the gaze's stages with detectors that see what the test says.
#include "app/pipelines/hands_stage.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "app/pipelines/gaze_stage.hpp"
#include "app/pipelines/hands_scene.hpp"

namespace armsreach::app {
namespace {

constexpr Timestamp kFrame = 33'333'333;

gesture::HandObservation showing(const std::string& gesture) {
  gesture::HandObservation hand;
  if (!gesture.empty()) hand.gesture = gesture;
  hand.score = 0.9;
  hand.center = {300, 300};
  hand.fingertip = {300, 200};
  hand.area = 100 * 100;
  hand.outline = {{250, 200}, {350, 200}, {350, 300}, {350, 400}, {250, 400}};
  return hand;
}

gesture::ColorBlob blob(const std::string& name, double x, double y) {
  return {name, cv::Rect(static_cast<int>(x) - 20, static_cast<int>(y) - 20, 41, 41), 1300, {x, y}};
}

class HandsStageTest : public testing::Test {
 protected:
  HandsStageTest() {
    std::ifstream table(ARMSREACH_SOURCE_DIR "/assets/gestures/transitions.yaml");
    HandsSetup setup;
    setup.inference.table = *gesture::read_gesture_table(table, "transitions.yaml");
    setup.detectors.look = [this](const Frame&) { return sees_; };
    stage_ = std::make_unique<HandsStage>(std::move(setup));
    auto sensor = std::make_shared<SensorInfo>();
    sensor->color_camera = pinhole(640, 480, 500, 500, 319.5, 239.5);
    sensor_ = sensor;
  }

  HandsOutput next(const cv::Scalar& color = {60, 120, 180}, int type = CV_8UC3) {
    auto frame = std::make_shared<Frame>();
    frame->index = index_++;
    frame->time = frame->index * kFrame;
    frame->color = cv::Mat(480, 640, type, color);
    for (int i = 0; i < 60; ++i)  // so that it can be told whether the camera has turned
      frame->color(cv::Rect(37 * i % 600, 53 * i % 450, 30, 20)).setTo(0.5 * color);
    frame->sensor = sensor_;
    auto tracked = std::make_shared<TrackedFrame>();
    tracked->frame = frame;
    tracked->state = state_;
    HandsOutput out = stage_->process(tracked);
    for (const Event& event : out.news.events) events_.push_back(event);
    for (const HandCommand& command : out.news.commands) commands_.push_back(command);
    return out;
  }
  HandsOutput show(const std::string& gesture, int frames) {
    sees_.hands = {showing(gesture)};
    HandsOutput out;
    for (int i = 0; i < frames; ++i) out = next();
    return out;
  }
  template <class Body>
  std::vector<Body> told() const {
    std::vector<Body> found;
    for (const Event& event : events_) {
      if (const auto* body = std::get_if<Body>(&event.body)) found.push_back(*body);
    }
    return found;
  }

  Sighting sees_;
  SensorInfoPtr sensor_;
  TrackingState state_ = TrackingState::untracked;
  std::unique_ptr<HandsStage> stage_;
  std::int64_t index_ = 0;
  Events events_;
  std::vector<HandCommand> commands_;
};

TEST_F(HandsStageTest, AGestureIsToldWhenItChangesAndWhenTheHandHasGone) {
  show("point", 20);
  sees_.hands.clear();
  for (int i = 0; i < 20; ++i) next();
  const auto gestures = told<GestureEvent>();
  ASSERT_EQ(gestures.size(), 2U);
  EXPECT_EQ(gestures[0].name, "point");
  EXPECT_EQ(gestures[0].pixel, Eigen::Vector2d(300, 300));
  EXPECT_EQ(gestures[1].name, "");
}

TEST_F(HandsStageTest, ImagesWithoutColourAreOneFaultAndTheFramesGoOn) {
  sees_.hands = {showing("point")};
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(next(cv::Scalar::all(90)).seen.tracked);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(next(cv::Scalar::all(90), CV_8UC1).seen.tracked);
  EXPECT_EQ(told<FaultEvent>().size(), 1U);
  EXPECT_TRUE(told<GestureEvent>().empty());
  for (int i = 0; i < 10; ++i) next();
  EXPECT_EQ(told<GestureEvent>().size(), 1U);
}

TEST_F(HandsStageTest, ABlobThatHasMadeNoGestureIsNoHand) {
  show("", 60);
  EXPECT_TRUE(show("point", 3).seen.hands->hands.empty());  // an edge that looked like one for once
  show("", 30);
  EXPECT_TRUE(told<GestureEvent>().empty());
  EXPECT_EQ(show("point", 20).seen.hands->hands.size(), 1U);
  EXPECT_EQ(show("", 60).seen.hands->hands.size(), 1U);  // it is still that hand
}

TEST_F(HandsStageTest, WhatTheCursorIsOnIsHighlightedOnce) {
  sees_.things = {blob("ball", 310, 190), blob("mug", 500, 100)};
  const HandsOutput out = show("point", 30);
  EXPECT_EQ(out.seen.hands->highlighted, 0U);
  const auto highlights = told<HighlightEvent>();
  ASSERT_EQ(highlights.size(), 1U);
  EXPECT_EQ(highlights[0].name, "ball");
  EXPECT_FALSE(highlights[0].point_in_world);  // neither pose nor depth
}

TEST_F(HandsStageTest, WhatAGraspPointsAtIsHighlighted) {
  sees_.things = {blob("ball", 310, 60), blob("mug", 500, 300)};
  EXPECT_EQ(show("grasp", 30).seen.hands->highlighted, 0U);
}

TEST_F(HandsStageTest, OfTwoThingsOfOneNameTheOneThatIsPointedAtIsMeant) {
  sees_.things = {blob("ball", 500, 400), blob("ball", 310, 190)};
  const HandsOutput out = show("point", 30);
  EXPECT_EQ(out.seen.hands->highlighted, 1U);
  const auto highlights = told<HighlightEvent>();
  ASSERT_EQ(highlights.size(), 1U);
  EXPECT_EQ(highlights[0].pixel, Eigen::Vector2d(310, 190));
  render::Scene scene;
  add_hands(*out.seen.hands, &scene);
  ASSERT_EQ(scene.marks.size(), 1U);
  EXPECT_EQ(scene.marks[0].corner, Eigen::Vector2f(290, 170));
}

TEST_F(HandsStageTest, GazeAfterAGraspTurnsToTheThingThatItPointsAt) {
  sees_.things = {blob("ball", 600, 400), blob("ball", 310, 60)};
  const HandsOutput out = show("grasp", 30);
  GazeStage gaze({"follow", "grasp", {}}, GimbalModel(), *sensor_->color_camera, {0, -1, 0}, 0);
  const Timestamp time = out.seen.tracked->frame->time;
  const auto angles =
      gaze.process({out.seen, GimbalState{time, {0, 0, 0}, {0, 0, 0}}}).command->angles;
  EXPECT_GT(angles[1], 0.1);             // up to the one above the hand,
  EXPECT_LT(std::abs(angles[0]), 0.05);  // not right to the other
}

TEST_F(HandsStageTest, AHandHoldsWhatItTouchesUnlessItPoints) {
  sees_.things = {blob("ball", 560, 60), blob("ball", 372, 300)};  // 2 px right of the hand's side
  EXPECT_EQ(show("grasp", 20).seen.hands->held, 1U);
  EXPECT_EQ(told<LabelEvent>().at(0).pixel, Eigen::Vector2d(372, 300));
  EXPECT_FALSE(show("point", 20).seen.hands->held);
  sees_.things[1] = blob("ball", 385, 300);  // 15 px: beside it
  EXPECT_FALSE(show("grasp", 20).seen.hands->held);
}

TEST_F(HandsStageTest, SelectingCarriesTheRayOfItsFrameWhereThePoseIsKnown) {
  show("point", 20);
  show("L", 20);
  ASSERT_EQ(commands_.size(), 1U);
  EXPECT_FALSE(commands_[0].ray_in_world);
  state_ = TrackingState::tracking;
  show("point", 20);
  show("L", 20);
  ASSERT_EQ(commands_.size(), 2U);
  ASSERT_TRUE(commands_[1].ray_in_world);
  const Eigen::Vector3d expected = unproject(*sensor_->color_camera, {300, 200}).normalized();
  EXPECT_LT((commands_[1].ray_in_world->direction_in_world - expected).norm(), 1e-9);
}

TEST_F(HandsStageTest, GazeTurnsToWhatItIsToldToFollow) {
  sees_.things = {blob("mug", 100, 240)};
  const HandsOutput out = show("point", 10);  // the hand is left of and below the middle
  const auto commanded = [&](const std::string& target) {
    GazeStage gaze({"follow", target, {}}, GimbalModel(), *sensor_->color_camera, {0, -1, 0}, 0);
    const Timestamp time = out.seen.tracked->frame->time;
    return gaze.process({out.seen, GimbalState{time, {0, 0, 0}, {0, 0, 0}}}).command->angles;
  };
  EXPECT_LT(commanded("hand")[0], -0.02);            // pan, left
  EXPECT_LT(commanded("hand")[1], -0.05);            // tilt, down
  EXPECT_LT(commanded("colour:mug")[0], -0.3);       // farther left,
  EXPECT_NEAR(commanded("colour:mug")[1], 0, 0.02);  // and level
  EXPECT_NEAR(commanded("colour:hat").norm(), 0, 1e-9);
}

TEST_F(HandsStageTest, GazeFollowsAHandThatHasMadeNoGestureOnceItMoves) {
  GazeStage gaze({"follow", "hand", {}}, GimbalModel(), *sensor_->color_camera, {0, -1, 0}, 0);
  const auto look = [&](double right) {
    sees_.hands = {showing("")};
    sees_.hands[0].center.x() += right;
    sees_.hands[0].area = 60 * 60;
    const HandsOutput out = next();
    const Timestamp time = out.seen.tracked->frame->time;
    return gaze.process({out.seen, GimbalState{time, {0, 0, 0}, {0, 0, 0}}}).command->angles;
  };
  for (int i = 0; i < 30; ++i) EXPECT_EQ(look(3 * (i % 2)).norm(), 0);  // a wall's ragged edge
  Eigen::Vector3d angles;
  for (int i = 0; i < 15; ++i) angles = look(10 * i);
  EXPECT_GT(angles[0], 0.2);  // after it, to the right
  for (int i = 0; i < 60; ++i) angles = look(140);
  EXPECT_NEAR(angles[0], std::atan2(440 - 319.5, 500), 0.02);  // and it is still that hand
}

}  // namespace
}  // namespace armsreach::app
