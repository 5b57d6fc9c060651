#include "devices/sim/sim_source.hpp"

#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/unit/devices/sim/same_picture.hpp"

namespace armsreach::sim {
namespace {

using testing::HasSubstr;

Result<std::unique_ptr<Source>> open(const std::string& text) {
  return open_source(*parse_source_spec(text), {}, sim_source_kinds());
}

std::vector<FramePtr> frames_of(const std::string& text) {
  auto source = open(text);
  EXPECT_TRUE(source.ok()) << source.error().message();
  std::vector<FramePtr> frames;
  while (true) {
    auto frame = (*source)->next();
    EXPECT_TRUE(frame.ok()) << frame.error().message();
    if (!frame || !*frame) return frames;
    frames.push_back(*frame);
  }
}

TEST(SimSource, TheSameSeedGivesTheSameBits) {
  const std::string spec = "sim:bench,width=160,speed=10,frames=5,seed=";
  const auto once = frames_of(spec + "7");
  const auto again = frames_of(spec + "7");
  const auto other = frames_of(spec + "8");
  ASSERT_EQ(once.size(), 5U);
  ASSERT_EQ(again.size(), 5U);
  ASSERT_EQ(other.size(), 5U);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_TRUE(same(once[i]->color, again[i]->color));
    EXPECT_TRUE(same(once[i]->depth, again[i]->depth));
    EXPECT_EQ(once[i]->world_from_camera->matrix(), again[i]->world_from_camera->matrix());
    EXPECT_FALSE(same(once[i]->color, other[i]->color));
    EXPECT_FALSE(same(once[i]->depth, other[i]->depth));
    EXPECT_NE(once[i]->world_from_camera->matrix(), other[i]->world_from_camera->matrix());
  }
}

TEST(SimSource, FramesAreCompleteAndOnTime) {
  const auto frames = frames_of("sim:bench,width=160,height=120,rate=20,frames=3");
  ASSERT_EQ(frames.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const Frame& frame = *frames[i];
    EXPECT_EQ(frame.index, static_cast<std::int64_t>(i));
    EXPECT_EQ(frame.time, static_cast<Timestamp>(i) * 50'000'000);
    EXPECT_EQ(frame.color.type(), CV_8UC3);
    EXPECT_EQ(frame.depth.type(), CV_32F);
    EXPECT_EQ(frame.color.size(), cv::Size(160, 120));
    EXPECT_EQ(frame.depth.size(), cv::Size(160, 120));
    ASSERT_TRUE(frame.sensor && frame.sensor->depth_camera && frame.sensor->color_camera);
    EXPECT_TRUE(frame.sensor->registered);
    EXPECT_EQ(frame.sensor->camera().width, 160);
    EXPECT_EQ(frame.sensor->rate, 20);
    EXPECT_TRUE(frame.world_from_camera.has_value());
    // There is something to see and to track.
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(frame.color, mean, deviation);
    EXPECT_GT(deviation[0], 20);
    EXPECT_GT(mean[0], 50);
    EXPECT_LT(mean[0], 200);
    EXPECT_GT(cv::countNonZero(frame.depth == frame.depth), 160 * 120 * 8 / 10);
  }
}

// A board that faces the camera, dull or glazed: the projector's own glare hides the middle.
TEST(SimSource, GlazeThatFacesTheDepthCameraHasAHole) {
  World world;
  world.path.duration = 1;
  world.path.keys = {{0, {0, 0, 0}, {0, 1, 0}, 0}, {1, {0, 0, 0}, {0, 1, 0}, 0}};
  Material board;
  board.colors = {Color::Constant(0.5)};
  world.materials = {board};
  const Eigen::AngleAxisd upright(0.5 * 3.14159265358979, Eigen::Vector3d::UnitX());
  world.things.resize(1);
  world.things[0].world_from_thing = Pose(Eigen::Quaterniond(upright), {0, 1, 0});
  world.parts = {{0, Panel{{2, 2}}, Pose(), 0}};
  const auto known = [&](double shine, const cv::Rect& place) {
    world.materials[0].shine = shine;
    const cv::Mat depth = (*make_sim_source(world, {})->next())->depth(place);
    return cv::countNonZero(depth == depth) / static_cast<double>(place.area());
  };
  const cv::Rect middle(310, 230, 20, 20);
  const cv::Rect aside(200, 230, 20, 20);  // 110 px are 11 deg
  EXPECT_EQ(known(0, middle), 1);
  EXPECT_EQ(known(0.5, middle), 0);
  EXPECT_EQ(known(0.5, aside), 1);
}

TEST(SimSource, EndsAfterOnceAlongThePath) {
  const auto source = *open("sim:near,width=32,height=24,rate=10");
  EXPECT_EQ(source->frame_count(), 60);  // 6 s
  EXPECT_EQ(open("sim:near,rate=10,speed=2").value()->frame_count(), 30);
  EXPECT_EQ(open("sim:near,loop=endless").value()->frame_count(), std::nullopt);
  for (int i = 0; i < 60; ++i) {
    auto frame = source->next();
    ASSERT_TRUE(frame.ok() && *frame) << i;
  }
  for (int i = 0; i < 2; ++i) {
    auto frame = source->next();
    ASSERT_TRUE(frame.ok());
    EXPECT_EQ(*frame, nullptr);
  }
}

TEST(SimSource, AClosedPathComesBackToItsFirstPicture) {
  const auto frames = frames_of("sim:near,width=64,noise=none,rate=1,frames=7");
  ASSERT_EQ(frames.size(), 7U);
  const Pose apart = frames[0]->world_from_camera->inverse() * *frames[6]->world_from_camera;
  EXPECT_LT(apart.log().norm(), 1e-9);
  EXPECT_LT(cv::norm(frames[0]->color, frames[6]->color, cv::NORM_INF), 2);
}

TEST(SimSource, StopEndsIt) {
  const auto source = *open("sim:bench,width=32,height=24");
  ASSERT_TRUE(*source->next() != nullptr);
  std::thread([&] { source->stop(); }).join();
  EXPECT_EQ(*source->next(), nullptr);
}

// As a runner does: read on a thread that is gone when the source is closed, beside another source.
TEST(SimSource, IsReadAndDestroyedOnAnyThread) {
  auto a = *open("sim:bench,width=32,height=24");
  auto b = *open("sim:near,width=32,height=24");
  std::thread([&] { EXPECT_TRUE(*a->next() != nullptr); }).join();
  std::thread([&] {
    EXPECT_TRUE(*a->next() != nullptr);
    EXPECT_TRUE(*b->next() != nullptr);
  }).join();
  a.reset();
  std::thread([&] { b.reset(); }).join();
  const auto never_read = open("sim:bench");
  EXPECT_TRUE(never_read.ok());
}

TEST(SimSource, RefusesWhatItDoesNotUnderstand) {
  const struct {
    const char* spec;
    const char* says;
  } refusals[] = {
      {"sim:moon", "no simulated world 'moon'"},  {"sim:bench,sed=1", "unknown option 'sed'"},
      {"sim:bench,seed=-1", "option 'seed'"},     {"sim:bench,noise=loud", "option 'noise'"},
      {"sim:bench,near=3,far=2", "depth range"},  {"sim:bench,loop=pingpong", "option 'loop'"},
      {"sim:bench,width=wide", "option 'width'"}, {"sim:bench,speed=0", "option 'speed'"},
      {"sim:bench,frames=0", "option 'frames'"},  {"sim:bench,rate=nan", "option 'rate'"},
  };
  for (const auto& refusal : refusals) {
    const auto source = open(refusal.spec);
    ASSERT_FALSE(source.ok()) << refusal.spec;
    EXPECT_THAT(source.error().what, HasSubstr(refusal.says));
    EXPECT_FALSE(source.error().remedy.empty());
  }
}

TEST(SimSource, WorldsAreListed) {
  const auto kinds = sim_source_kinds();
  ASSERT_EQ(kinds.size(), 2U);  // sim and sim-hand
  const auto worlds = kinds[0].probe();
  ASSERT_GE(worlds.size(), 2U);
  EXPECT_EQ(worlds[0].spec, "sim:bench");
  for (const Availability& world : worlds) EXPECT_TRUE(world.usable) << world.detail;
}

}  // namespace
}  // namespace armsreach::sim
