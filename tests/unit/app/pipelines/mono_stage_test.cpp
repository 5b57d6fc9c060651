#include "app/pipelines/mono_stage.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

namespace armsreach::app {
namespace {

SensorInfoPtr plain_sensor() {
  auto sensor = std::make_shared<SensorInfo>();
  sensor->color_camera = pinhole(640, 480, 520, 520, 319.5, 239.5);
  return sensor;
}

// A fixed picture of many corners.
FramePtr frame(const SensorInfoPtr& sensor, std::int64_t index) {
  auto out = std::make_shared<Frame>();
  out->index = index;
  out->time = index * 33'333'333;
  out->sensor = sensor;
  cv::Mat coarse(24, 32, CV_8UC1);
  cv::RNG random(7);
  random.fill(coarse, cv::RNG::UNIFORM, 40, 220);
  cv::Mat grey;
  cv::resize(coarse, grey, {640, 480}, 0, 0, cv::INTER_NEAREST);
  cv::cvtColor(grey, out->color, cv::COLOR_GRAY2BGR);
  return out;
}

HandsStatePtr hand_on_the_left(const std::string& gesture) {
  auto hands = std::make_shared<HandsState>();
  gesture::Hand hand;
  hand.gesture = gesture;
  hand.seen.outline = {{-1, -1}, {320, -1}, {320, 480}, {-1, 480}};
  hands->hands = {hand};
  return hands;
}

int points_left_of(const TrackedFrame& tracked, double x) {
  int count = 0;
  for (const auto& point : tracked.mono->points) {
    const auto pixel =
        project(tracked.camera, tracked.world_from_camera.inverse() * point.position);
    if (pixel && pixel->x() < x) ++count;
  }
  return count;
}

TEST(MonoStage, AStatedScaleIsSaidOnceAndThePictureIsReduced) {
  const auto sensor = plain_sensor();
  MonoSetup setup;
  setup.options.stated_distance = 0.7;
  MonoStage stage(*sensor, setup, std::nullopt);
  const MonoStageOutput first = stage.process({frame(sensor, 0)});
  EXPECT_EQ(first.tracked->state, TrackingState::tracking);
  EXPECT_EQ(first.tracked->camera.width, 320);
  ASSERT_EQ(first.events.size(), 1U);
  EXPECT_NE(std::get<FaultEvent>(first.events[0].body).message.find("0.7 m"), std::string::npos);
  EXPECT_TRUE(stage.process({frame(sensor, 1)}).events.empty());
  EXPECT_EQ(stage.statistics().json()["scale"], "stated");
}

std::vector<std::string> messages(const MonoStageOutput& output) {
  std::vector<std::string> all;
  for (const Event& event : output.events) {
    if (const auto* fault = std::get_if<FaultEvent>(&event.body)) all.push_back(fault->message);
  }
  return all;
}

// Nothing within a depth camera's range, for a second: then the scale is stated, and said to be.
TEST(MonoStage, DepthThatShowsNothingIsSaidAndTheScaleStated) {
  auto sensor = std::make_shared<SensorInfo>(*plain_sensor());
  sensor->depth_camera = sensor->color_camera;
  MonoStage stage(*sensor, {}, std::nullopt);
  MonoStageOutput output;
  for (int i = 0; i <= 30; ++i) {
    EXPECT_TRUE(output.events.empty()) << i;
    auto blind = std::make_shared<Frame>(*frame(sensor, i));
    blind->depth = cv::Mat(480, 640, CV_32F, cv::Scalar(std::nan("")));
    output = stage.process({blind});
  }
  EXPECT_EQ(output.tracked->state, TrackingState::tracking);
  ASSERT_EQ(messages(output).size(), 2U);
  EXPECT_NE(messages(output)[0].find("depth frames show too little"), std::string::npos);
  EXPECT_NE(messages(output)[1].find("stated, not measured"), std::string::npos);
  EXPECT_GT(output.tracked->inliers, 0);
}

TEST(MonoStage, ATargetThatIsTooSmallIsAskedToComeCloserOnce) {
  const auto sensor = plain_sensor();
  MonoSetup setup;
  setup.options.target.emplace();
  setup.options.target->rectangle = mono_slam::StartTarget::Rectangle{0.21, 0.1485};
  MonoStage stage(*sensor, setup, std::nullopt);
  auto far = std::make_shared<Frame>(*frame(sensor, 0));
  far->color = cv::Scalar(220, 220, 220);
  cv::rectangle(far->color, cv::Rect(290, 220, 76, 54), cv::Scalar(20, 20, 20), cv::FILLED);
  std::vector<std::string> told;
  for (int i = 0; i < 5; ++i) {
    const MonoStageOutput output = stage.process({far});
    EXPECT_EQ(output.tracked->state, TrackingState::initialising);
    for (const std::string& message : messages(output)) told.push_back(message);
  }
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("too small"), std::string::npos);
}

TEST(MonoStage, NothingIsMappedOnAHandThatShowsAGesture) {
  const auto sensor = plain_sensor();
  MonoStage kept_off(*sensor, {}, std::nullopt);
  MonoStage unsure(*sensor, {}, std::nullopt);
  const auto tracked = kept_off.process({frame(sensor, 0), hand_on_the_left("open")}).tracked;
  EXPECT_EQ(points_left_of(*tracked, 160), 0);
  EXPECT_GT(points_left_of(*tracked, 320), 5);
  // Wood and walls have the colour of skin, too.
  EXPECT_GT(points_left_of(*unsure.process({frame(sensor, 0), hand_on_the_left("")}).tracked, 160),
            5);
}

TEST(MonoStage, AFrameWithoutAPictureIsAFault) {
  const auto sensor = plain_sensor();
  MonoStage stage(*sensor, {}, std::nullopt);
  auto blind = std::make_shared<Frame>(*frame(sensor, 0));
  blind->color.release();
  EXPECT_THROW(stage.process({blind}), std::exception);
}

TEST(PixelHistogram, QuantilesAreRightToABin) {
  PixelHistogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), 0);
  for (int i = 1; i <= 100; ++i) histogram.add(0.1 * i);
  EXPECT_NEAR(histogram.quantile(0.5), 5, 0.03);
  EXPECT_NEAR(histogram.quantile(0.9), 9, 0.03);
  histogram.add(1e9);
  EXPECT_LE(histogram.quantile(1), 30);
}

}  // namespace
}  // namespace armsreach::app
