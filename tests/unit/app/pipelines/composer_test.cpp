// What the composer makes of results: events that skipped scenes do not lose, poses that are known.
#include "app/pipelines/composer.hpp"

#include <gtest/gtest.h>

namespace armsreach::app {
namespace {

Pose at(const Eigen::Vector3d& place) { return {Eigen::Quaterniond::Identity(), place}; }

TrackedFramePtr tracked(std::int64_t index, TrackingState state = TrackingState::tracking) {
  auto sensor = std::make_shared<SensorInfo>();
  sensor->color_camera = pinhole(64, 48, 60, 60, 31.5, 23.5);
  auto frame = std::make_shared<Frame>();
  frame->index = index;
  frame->time = index * 33'000'000;
  frame->arrival = frame->time;
  frame->color = cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(90));
  frame->sensor = sensor;
  auto out = std::make_shared<TrackedFrame>();
  out->frame = frame;
  out->state = state;
  return out;
}

Composer composer(const EventLog& log, Placement placement = {}) {
  return Composer(
      log, std::move(placement), HandInteraction("teapot"),
      [] { return std::vector<render::StageRow>(); }, [] { return 0.0; });
}

// A click where nothing is mapped: one fault.
UserInput click_at_nothing() {
  UserInput user;
  user.clicks.push_back({{{0, 0, 0}, {0, 0, 1}}, "teapot"});
  return user;
}

TEST(Composer, EventsOfASkippedSceneComeAgainWithTheirNumbers) {
  const EventLog log;
  Composer composing = composer(log);
  composing.process({tracked(0), nullptr, {click_at_nothing()}});
  const ComposedPtr second = composing.process({tracked(1), nullptr, {click_at_nothing()}});
  ASSERT_EQ(second->events.size(), 2U);
  EXPECT_EQ(second->events_before, 0);
}

TEST(Composer, ClicksOnAFrameThatFailedAreDoneOnTheNext) {
  const EventLog log;
  Composer composing = composer(log);
  EXPECT_FALSE(composing.process({nullptr, nullptr, {click_at_nothing()}}));
  EXPECT_EQ(composing.process({tracked(1), nullptr, {}})->events.size(), 1U);
}

TEST(Composer, ALostFramesPoseIsNotDrawnWithARelocalisedOnesIs) {
  const EventLog log;
  Composer composing = composer(log);
  const auto known = [&](TrackingState state) {
    return composing.process({tracked(0, state), nullptr, {}})->scene->pose_known;
  };
  EXPECT_FALSE(known(TrackingState::lost));
  EXPECT_TRUE(known(TrackingState::relocalised));
  EXPECT_TRUE(known(TrackingState::tracking));
}

TEST(Composer, TheTrackingsStateIsShownOnceAndNotAsAMessageToo) {
  EventLog log;
  log.write({0, TrackingEvent{TrackingState::initialising, 0, 0}});
  log.write({1, TrackingEvent{TrackingState::tracking, 0, 0}});
  Composer composing = composer(log);
  const auto scene = composing.process({tracked(1), nullptr, {}})->scene;
  EXPECT_EQ(scene->tracking_state, "tracking");
  EXPECT_TRUE(scene->messages.empty());
}

TEST(Composer, ObjectsOfAnotherDayStandWhereTheyStood) {
  const EventLog log;
  const Pose there = at({0.3, 0, 1});
  Composer composing = composer(log, Placement({{7, "cube", {0, there}, false}}));
  const ComposedPtr composed = composing.process({tracked(0), nullptr, {}});
  ASSERT_EQ(composed->scene->objects.size(), 1U);
  EXPECT_EQ(composed->scene->objects[0].id, 7);
  EXPECT_TRUE(composed->scene->objects[0].world_from_object.translation() == there.translation());
}

}  // namespace
}  // namespace armsreach::app
