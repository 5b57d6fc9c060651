// Simulated hands over other sources.
#include "devices/sim/hand_source.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "devices/sim/hand/hand_actor.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/sim/worlds.hpp"

namespace armsreach::sim {
namespace {

using testing::HasSubstr;

const Camera kCamera = pinhole(160, 120, 140, 140, 79.5, 59.5);

// A grey wall, at `depth` metres, in front of which there is a screen over the right half.
class Wall final : public Source {
 public:
  Wall(float wall, float screen, bool grey) : grey_(grey) {
    auto info = std::make_shared<SensorInfo>();
    info->color_camera = kCamera;
    info->depth_camera = kCamera;
    info_ = info;
    depth_ = cv::Mat(120, 160, CV_32F, cv::Scalar(wall));
    depth_.colRange(80, 160).setTo(screen);
  }
  const std::shared_ptr<const SensorInfo>& sensor() const override { return info_; }
  Result<FramePtr> next() override {
    auto frame = std::make_shared<Frame>();
    frame->index = index_;
    frame->time = 1'000'000'000 + index_++ * 100'000'000;
    frame->color = cv::Mat(120, 160, grey_ ? CV_8UC1 : CV_8UC3, cv::Scalar::all(90));
    frame->depth = depth_;
    frame->sensor = info_;
    return FramePtr(frame);
  }

 private:
  std::shared_ptr<const SensorInfo> info_;
  cv::Mat depth_;
  bool grey_;
  std::int64_t index_ = 0;
};

HandDescription open_hand(HandFrame frame = HandFrame::camera) {
  HandDescription hand;
  hand.frame = frame;
  HandKey key;
  key.at = {0, 0, 0.5};
  hand.keys.push_back(key);
  return hand;
}

FramePtr first_frame(float wall, float screen, bool grey = false) {
  const auto source = make_hand_source(std::make_unique<Wall>(wall, screen, grey), {open_hand()});
  auto frame = source->next();
  EXPECT_TRUE(frame.ok()) << frame.error().message();
  return *frame;
}

int covered(const cv::Mat& depth, float from, float to) {
  return cv::countNonZero((depth > from) & (depth < to));
}

TEST(HandSource, TheHandIsInColourAndDepthWhereItIs) {
  const FramePtr frame = first_frame(2, 2);
  // The palm's middle, half a metre away, before the image's centre. Thickness of a hand: 4 cm.
  EXPECT_NEAR(frame->depth.at<float>(60, 79), 0.49F, 0.03F);
  const cv::Vec3b skin = frame->color.at<cv::Vec3b>(60, 79);
  EXPECT_GT(skin[2], skin[0] + 20);  // red more than blue
  EXPECT_EQ(frame->color.at<cv::Vec3b>(5, 5), cv::Vec3b(90, 90, 90));
  EXPECT_EQ(frame->depth.at<float>(5, 5), 2);
  // Palm and fingers of about 130 cm^2 and the arm below, at 280 px/m.
  const int pixels = covered(frame->depth, 0.4F, 0.6F);
  EXPECT_GT(pixels, 900);
  EXPECT_LT(pixels, 4000);
}

TEST(HandSource, WhatIsInFrontHidesIt) {
  const FramePtr free = first_frame(2, 2);
  const FramePtr half = first_frame(2, 0.3F);
  EXPECT_EQ(covered(half->depth.colRange(80, 160), 0.4F, 0.6F), 0);
  EXPECT_GT(covered(half->depth.colRange(0, 79), 0.4F, 0.6F),
            0.9 * covered(free->depth.colRange(0, 79), 0.4F, 0.6F));
  EXPECT_EQ(half->color.at<cv::Vec3b>(60, 90), cv::Vec3b(90, 90, 90));
  // Nothing known is nothing in front.
  const FramePtr unknown = first_frame(2, std::numeric_limits<float>::quiet_NaN());
  EXPECT_GT(covered(unknown->depth.colRange(80, 160), 0.4F, 0.6F), 300);
}

TEST(HandSource, GreyCamerasSeeItGrey) {
  const FramePtr frame = first_frame(2, 2, true);
  EXPECT_EQ(frame->color.type(), CV_8UC1);
  EXPECT_NE(frame->color.at<std::uint8_t>(60, 79), 90);
}

TEST(HandSource, TheSceneBehindIsNotWrittenTo) {
  auto scene = std::make_unique<Wall>(2.0F, 2.0F, false);
  auto before = scene->next();
  const auto source = make_hand_source(std::move(scene), {open_hand()});
  ASSERT_TRUE(source->next().ok());
  EXPECT_EQ(covered((*before)->depth, 0, 1), 0);
}

TEST(HandSource, AHandInTheWorldNeedsAPose) {
  const auto source =
      make_hand_source(std::make_unique<Wall>(2, 2, false), {open_hand(HandFrame::world)});
  const auto frame = source->next();
  ASSERT_FALSE(frame.ok());
  EXPECT_THAT(frame.error().message(), HasSubstr("pose"));
}

TEST(HandSource, OpensBySpecificationWithTheOptionsOfBoth) {
  const auto open = [](const std::string& text) {
    return open_source(*parse_source_spec(text), {}, sim_source_kinds());
  };
  auto source = open("sim-hand:sim:bench,script=gestures,width=64,noise=none");
  ASSERT_TRUE(source.ok()) << source.error().message();
  EXPECT_EQ((*source)->sensor()->camera().width, 64);
  EXPECT_THAT(open("sim-hand:sim:bench,script=waltz").error().message(), HasSubstr("waltz"));
  EXPECT_THAT(open("sim-hand:sim:bench,script=/none.yaml").error().message(),
              HasSubstr("/none.yaml"));
  EXPECT_THAT(open("sim-hand:tum:/nowhere").error().message(), HasSubstr("/nowhere"));
  EXPECT_THAT(open("sim-hand:sim:bench,rate=30,colour=2").error().message(), HasSubstr("colour"));
}

// In a simulated world: exact depth, truth and drawing agree.
TEST(HandsInAWorld, DepthIsThatOfTheTruthsJoints) {
  World world = *load_world("bench");
  world.sensor.width = 320;
  world.sensor.height = 240;
  world.sensor.noise = 0;
  world.sensor.nearest = 0;
  HandDescription left = open_hand();
  left.left = true;
  left.keys[0].at = {-0.12, 0, 0.5};
  left.keys[0].gesture = Gesture::five;
  world.hands = {open_hand(), left};
  world.hands[0].keys[0].at = {0.12, 0, 0.5};
  const auto source = make_sim_source(world, {});
  const auto frame = source->next();
  ASSERT_TRUE(frame.ok()) << frame.error().message();
  for (const HandDescription& hand : world.hands) {
    const HandTruth truth = HandActor(hand).truth(0, *(*frame)->world_from_camera);
    for (const HandJoint joint : {HandJoint::index_distal, HandJoint::middle_intermediate,
                                  HandJoint::ring_proximal, HandJoint::little_intermediate}) {
      const Eigen::Vector3d in_camera =
          (*frame)->world_from_camera->inverse() *
          truth.world_from_joint[static_cast<std::size_t>(joint)].translation();
      const auto pixel = project((*frame)->sensor->camera(), in_camera);
      ASSERT_TRUE(pixel.has_value());
      const double depth = static_cast<double>((*frame)->depth.at<float>(
          static_cast<int>(std::lround(pixel->y())), static_cast<int>(std::lround(pixel->x()))));
      // The skin is a finger's radius before the joint: 5 to 14 mm.
      EXPECT_GT(in_camera.z() - depth, 0.004) << name(joint);
      EXPECT_LT(in_camera.z() - depth, 0.016) << name(joint);
    }
  }
}

TEST(HandsInAWorld, AreTheSameEveryTime) {
  World world = *load_world("bench");
  world.sensor.width = 64;
  world.sensor.height = 48;
  world.hands = {open_hand()};
  const auto a = make_sim_source(world, {});
  const auto b = make_sim_source(world, {});
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(cv::norm((*a->next())->color, (*b->next())->color, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace armsreach::sim
