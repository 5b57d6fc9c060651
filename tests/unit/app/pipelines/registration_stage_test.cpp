#include "app/pipelines/registration_stage.hpp"

#include <cmath>
#include <memory>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/synthetic_room.hpp"
#include "vision/core/camera_yaml.hpp"

namespace armsreach::app {
namespace {

using testing::HasSubstr;

const std::shared_ptr<const SensorInfo> kAssumed = test::synthetic_sensor(320);

// Depth and colour of two cameras beside each other, or of one, on a sweep through a room.
FramePtr seen(std::int64_t index, bool side_by_side) {
  const test::SyntheticRoom room;
  const double t = 0.1 * static_cast<double>(index);
  const Pose pose(so3_exp({-0.1, 0.25 * std::sin(t), 0}), {0.3 * std::sin(0.7 * t), -0.2, 0});
  auto frame = std::make_shared<Frame>(*room.frame(kAssumed, pose, index));
  if (!side_by_side) return frame;
  auto color = std::make_shared<SensorInfo>(*kAssumed);
  color->depth_camera->fx *= 0.9;
  color->depth_camera->fy *= 0.9;
  const Pose color_from_depth({1, 0, 0, 0}, {-0.025, 0, 0});
  frame->color = room.frame(color, pose * color_from_depth.inverse(), index)->color;
  return frame;
}

RegistrationStatePtr after_a_verdict(RegistrationStage& stage, bool side_by_side) {
  RegistrationStatePtr state;
  for (std::int64_t i = 0; i < 100 && !state; ++i) state = stage.process(seen(i, side_by_side));
  return state;
}

TEST(RegistrationStage, TellsOfTheColorCameraAndHowToKeepIt) {
  RegistrationStage stage(kAssumed);
  const RegistrationStatePtr state = after_a_verdict(stage, true);
  ASSERT_TRUE(state && state->sensor && state->fault);
  EXPECT_FALSE(state->sensor->registered);
  EXPECT_NEAR(state->sensor->color_camera->fx / kAssumed->color_camera->fx, 0.9, 0.01);
  EXPECT_THAT(state->fault->message, HasSubstr("not registered"));
  const std::string& remedy = state->fault->remedy;
  std::istringstream file(remedy.substr(remedy.find('\n') + 1));
  const auto camera = read_camera_yaml(file, "remedy");
  ASSERT_TRUE(camera) << camera.error().message();
  EXPECT_EQ(camera->camera.fx, state->sensor->color_camera->fx);
  EXPECT_EQ(camera->camera_from_depth->translation().x(),
            state->sensor->color_from_depth.translation().x());
}

// Live, a reader sees only the newest output.
TEST(RegistrationStage, GoesOnGivingWhatItKnows) {
  RegistrationStage stage(kAssumed);
  const RegistrationStatePtr state = after_a_verdict(stage, true);
  EXPECT_EQ(stage.process(seen(101, true)), state);
  EXPECT_EQ(stage.process(seen(102, true)), state);
}

TEST(RegistrationStage, OfRegisteredImagesThereIsNothingToTell) {
  RegistrationStage stage(kAssumed);
  const RegistrationStatePtr state = after_a_verdict(stage, false);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->registration, Registration::registered);
  EXPECT_FALSE(state->fault);
  const FramePtr frame = seen(101, false);
  EXPECT_EQ(with_known_color(frame, state), frame);
}

TEST(RegistrationStage, SaysWhenItCannotTell) {
  RegistrationStage stage(kAssumed);
  RegistrationStatePtr state;
  auto dark = std::make_shared<Frame>(*seen(0, true));
  dark->color = cv::Mat(dark->color.size(), CV_8UC1, cv::Scalar(0));
  for (int i = 0; i < 100 && !state; ++i) state = stage.process(dark);
  ASSERT_TRUE(state && state->fault);
  EXPECT_EQ(state->registration, Registration::cannot_tell);
  EXPECT_THAT(state->fault->remedy, HasSubstr("camera_color.yaml"));
  EXPECT_EQ(with_known_color(dark, state), dark);
}

}  // namespace
}  // namespace armsreach::app
