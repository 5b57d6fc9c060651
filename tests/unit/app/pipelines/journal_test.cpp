// What is written down of tracked frames.
#include "app/pipelines/journal.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "vision/core/trajectory.hpp"

namespace armsreach::app {
namespace {

TrackedFramePtr tracked(std::int64_t index, TrackingState state) {
  auto frame = std::make_shared<Frame>();
  frame->index = index;
  frame->time = index * 100'000'000;
  frame->arrival = 5'000'000'000 + frame->time;
  auto out = std::make_shared<TrackedFrame>();
  out->frame = frame;
  out->state = state;
  out->depth = cv::Mat(1, 1, CV_32F, cv::Scalar(1));
  out->world_from_camera =
      Pose(Eigen::Quaterniond::Identity(), {0.1 * static_cast<double>(index), 0, 0});
  return out;
}

TEST(Journal, PosesOfLostFramesAreNotWritten) {
  const test::TemporaryFolder folder;
  EventLog log;
  Journal journal(log);
  ASSERT_TRUE(journal.open((folder / "t.txt").string()));
  using enum TrackingState;
  std::int64_t index = 0;
  for (TrackingState state : {initialising, tracking, lost, lost, relocalised, tracking}) {
    journal.record(*entry_from_tracked(tracked(index++, state)));
  }
  ASSERT_TRUE(journal.close());
  std::istringstream text(test::read_text(folder / "t.txt"));
  const auto written = read_tum_trajectory(text, "t.txt");
  ASSERT_TRUE(written);
  ASSERT_EQ(written->size(), 4U);
  EXPECT_EQ((*written)[2].time, 400'000'000);  // the frame that was found again
  EXPECT_EQ(journal.frames(), 6);
  EXPECT_EQ(journal.tracked_frames(), 4);
  EXPECT_DOUBLE_EQ(journal.rate(), 10);
}

TEST(Journal, AnEventWhereTheStateChangesAndOnlyThere) {
  EventLog log;
  Journal journal(log);
  using enum TrackingState;
  std::int64_t index = 0;
  for (TrackingState state : {initialising, tracking, tracking, lost, lost, tracking}) {
    journal.record(*entry_from_tracked(tracked(index++, state)));
  }
  std::vector<TrackingState> told;
  for (const Event& event : log.recent()) told.push_back(std::get<TrackingEvent>(event.body).state);
  EXPECT_EQ(told, (std::vector<TrackingState>{initialising, tracking, lost, tracking}));
}

TEST(Journal, APoseThatWasOnlyPredictedIsNotWritten) {
  EventLog log;
  Journal journal(log);
  TrackedFrame covered = *tracked(0, TrackingState::tracking);
  journal.record(*entry_from_tracked(std::make_shared<const TrackedFrame>(covered)));
  covered.pose_seen = false;
  journal.record(*entry_from_tracked(std::make_shared<const TrackedFrame>(covered)));
  EXPECT_EQ(journal.frames(), 2);
  EXPECT_EQ(journal.tracked_frames(), 1);
  EXPECT_EQ(log.recent().size(), 1U) << "the state is still tracking";
}

TEST(Journal, BeforeAnythingWasSeenNoPoseIsKnown) {
  EventLog log;
  Journal journal(log);
  TrackedFrame blind = *tracked(0, TrackingState::initialising);
  blind.depth = cv::Mat();
  journal.record(*entry_from_tracked(std::make_shared<const TrackedFrame>(blind)));
  EXPECT_EQ(journal.frames(), 1);
  EXPECT_EQ(journal.tracked_frames(), 0);
}

TEST(Journal, AFrameOnWhichTheTrackerFailedIsNoEntry) { EXPECT_FALSE(entry_from_tracked(nullptr)); }

}  // namespace
}  // namespace armsreach::app
