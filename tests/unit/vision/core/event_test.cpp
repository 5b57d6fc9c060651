#include "vision/core/event.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace armsreach {
namespace {

TEST(Event, JsonHasTimeTypeAndFields) {
  const auto tracking =
      json_from_event({1'500'000'000, TrackingEvent{TrackingState::lost, 1.5, 12}});
  EXPECT_EQ(tracking["t"], 1.5);
  EXPECT_EQ(tracking["type"], "tracking");
  EXPECT_EQ(tracking["state"], "lost");
  EXPECT_EQ(tracking["inliers"], 12);

  const auto fault =
      json_from_event({0, FaultEvent{"tracking", "out of memory", "close something"}});
  EXPECT_EQ(fault["type"], "fault");
  EXPECT_EQ(fault["component"], "tracking");
  EXPECT_EQ(fault["remedy"], "close something");

  const auto gaze = json_from_event({0, GazeEvent{GazeMode::saccade, {0.5, -0.25, 0.125}, "mug"}});
  EXPECT_EQ(gaze["type"], "gaze");
  EXPECT_EQ(gaze["mode"], "saccade");
  EXPECT_EQ(gaze["pan"], 0.5);
  EXPECT_EQ(gaze["tilt"], -0.25);
  EXPECT_EQ(gaze["roll"], 0.125);
  EXPECT_EQ(gaze["target"], "mug");

  const auto insert = json_from_event({0, InsertEvent{"teapot", 3, Pose()}});
  EXPECT_EQ(insert["type"], "insert");
  EXPECT_EQ(insert["id"], 3);
  EXPECT_EQ(insert["world_from_object"]["rotation"][3], 1.0);
}

}  // namespace
}  // namespace armsreach
