#include "app/pipelines/mono_stage.hpp"

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
