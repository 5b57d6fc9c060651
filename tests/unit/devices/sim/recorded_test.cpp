// A recording equals its source: the images bit for bit, the poses and the truth to the last
// digits.
#include <csignal>
#include <string>
#include <sys/resource.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "devices/open.hpp"
#include "devices/recorded_gimbal.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/truth.hpp"
#include "devices/tum_writer.hpp"
#include "tests/support/program.hpp"
#include "tests/unit/devices/sim/same_picture.hpp"

namespace armsreach::sim {
namespace {

std::unique_ptr<Source> open(const std::string& text) {
  std::vector<SourceKind> kinds = real_source_kinds();
  for (SourceKind& kind : sim_source_kinds()) kinds.push_back(std::move(kind));
  auto source = open_source(*parse_source_spec(text), {}, kinds);
  EXPECT_TRUE(source.ok()) << source.error().message();
  return std::move(*source);
}

// Rotations are normalised anew when they are read, which may change their last digit.
void expect_same(const Pose& a, const Pose& b) { EXPECT_LT((a.inverse() * b).log().norm(), 1e-14); }

void expect_same(const Truth& a, const Truth& b, double units_per_metre) {
  expect_same(a.world_from_camera, b.world_from_camera);
  EXPECT_TRUE(same(a.masks, b.masks));
  ASSERT_EQ(a.depth.size(), b.depth.size());
  // The true depth is written in whole units.
  EXPECT_LE(cv::norm(a.depth, b.depth, cv::NORM_INF, a.depth == a.depth),
            0.5001 / units_per_metre + 1e-6);
  ASSERT_EQ(a.things.size(), b.things.size());
  for (std::size_t i = 0; i < a.things.size(); ++i) {
    EXPECT_EQ(a.things[i].name, b.things[i].name);
    EXPECT_EQ(a.things[i].mask, b.things[i].mask);
    expect_same(a.things[i].world_from_thing, b.things[i].world_from_thing);
  }
  EXPECT_EQ(a.contacts, b.contacts);
  ASSERT_EQ(a.gimbal.has_value(), b.gimbal.has_value());
  if (a.gimbal) {
    EXPECT_EQ(a.gimbal->angles, b.gimbal->angles);
  }
  ASSERT_EQ(a.markers.size(), b.markers.size());
  for (std::size_t i = 0; i < a.markers.size(); ++i) {
    EXPECT_EQ(a.markers[i].name, b.markers[i].name);
    EXPECT_EQ(a.markers[i].point_in_world, b.markers[i].point_in_world);
    EXPECT_EQ(a.markers[i].visible, b.markers[i].visible);
  }
  ASSERT_EQ(a.hands.size(), b.hands.size());
  for (std::size_t i = 0; i < a.hands.size(); ++i) {
    EXPECT_EQ(a.hands[i].name, b.hands[i].name);
    EXPECT_EQ(a.hands[i].mask, b.hands[i].mask);
    EXPECT_EQ(a.hands[i].gesture, b.hands[i].gesture);
    EXPECT_EQ(a.hands[i].holds, b.hands[i].holds);
    for (std::size_t k = 0; k < kTrueHandJoints; ++k)
      expect_same(a.hands[i].world_from_joint[k], b.hands[i].world_from_joint[k]);
  }
}

TEST(Recorded, EqualsItsSource) {
  const test::TemporaryFolder folder;
  const std::string spec =
      "sim:packaging,mount=shoulder,gimbal=yes,width=160,rate=7,speed=3,frames=9,seed=5";
  const auto first = open(spec);
  const auto gimbal = std::dynamic_pointer_cast<Gimbal>(first->actuators().at(0));
  ASSERT_TRUE(gimbal->command({100'000'000, {0.3, -0.1, 0.05}}).ok());
  TumWriter writer(folder / "made");
  ASSERT_TRUE(writer.begin(*first->sensor()).ok());
  std::vector<FramePtr> frames;
  while (const FramePtr frame = *first->next()) {
    frames.push_back(frame);
    ASSERT_TRUE(writer.write(*frame).ok());
    ASSERT_TRUE(writer.write_gimbal(*gimbal, frame->time).ok());
  }
  ASSERT_EQ(frames.size(), 9U);

  const auto played = open("tum:" + (folder / "made").string());
  EXPECT_TRUE(played->sensor()->registered);
  EXPECT_TRUE(played->sensor()->registration_stated);
  EXPECT_NEAR(played->sensor()->rate, 7, 1e-6);
  for (const FramePtr& frame : frames) {
    const FramePtr again = *played->next();
    ASSERT_TRUE(again);
    EXPECT_EQ(frame->time, again->time);
    EXPECT_TRUE(same(frame->color, again->color));
    EXPECT_TRUE(same(frame->depth, again->depth));
    expect_same(*frame->world_from_camera, *again->world_from_camera);
    ASSERT_TRUE(again->truth);
    expect_same(*frame->truth, *again->truth, first->sensor()->camera().depth_units_per_metre);
  }
  EXPECT_EQ(*played->next(), nullptr);

  auto states = open_recorded_gimbal("main", gimbal->model(), folder / "made" / "gimbal.txt");
  ASSERT_TRUE(states.ok()) << states.error().message();
  for (const FramePtr& frame : frames) {
    const auto state = (*states)->state_at(frame->time);
    ASSERT_TRUE(state.has_value());
    EXPECT_EQ(state->angles, frame->truth->gimbal->angles);
  }
  EXPECT_THAT(test::read_text(folder / "made" / "commands.jsonl"),
              testing::HasSubstr("[0.3,-0.1,0.05]"));
  ASSERT_TRUE((*states)->command({0, {0, 0, 0}}).ok());
  EXPECT_EQ((*states)->take_events().size(), 1U) << "it says that it cannot be moved";
}

TEST(Recorded, KeepsMarkersAndHandsThatWereDrawnIn) {
  for (const std::string spec : {"sim:haptic-table,width=64,speed=10,frames=3",
                                 "sim-hand:sim:bench,width=64,speed=10,frames=3"}) {
    const test::TemporaryFolder folder;
    const auto first = open(spec);
    TumWriter writer(folder / "made");
    ASSERT_TRUE(writer.begin(*first->sensor()).ok());
    std::vector<FramePtr> frames;
    while (const FramePtr frame = *first->next()) {
      frames.push_back(frame);
      ASSERT_TRUE(writer.write(*frame).ok());
    }
    const auto played = open("tum:" + (folder / "made").string());
    for (const FramePtr& frame : frames) {
      const FramePtr again = *played->next();
      ASSERT_TRUE(again && again->truth);
      ASSERT_EQ(frame->truth->hands.size(), 1U);
      expect_same(*frame->truth, *again->truth, first->sensor()->camera().depth_units_per_metre);
    }
  }
}

TEST(Recorded, ABrokenOffOneIsAShorterOne) {
  const test::TemporaryFolder folder;
  const auto source = open("sim:bench,width=64,frames=2");
  {
    TumWriter writer(folder / "made");
    ASSERT_TRUE(writer.begin(*source->sensor()).ok());
    ASSERT_TRUE(writer.write(**source->next()).ok());
    const auto meanwhile = open("tum:" + (folder / "made").string());
    EXPECT_EQ(meanwhile->frame_count(), 1);
    EXPECT_TRUE(meanwhile->next().ok());
  }
}

// Stands for a full disk: files may not grow beyond a size.
TEST(Recorded, AFullDiskIsAnErrorThatNamesTheFile) {
  const test::TemporaryFolder folder;
  const auto source = open("sim:bench,width=320,frames=2");
  TumWriter writer(folder / "made");
  ASSERT_TRUE(writer.begin(*source->sensor()).ok());
  const FramePtr frame = *source->next();
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const Status status = writer.write(*frame);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, Error::Kind::device);
  EXPECT_THAT(status.error().where, testing::HasSubstr("rgb/"));
}

}  // namespace
}  // namespace armsreach::sim
