// The tracker in a world that was mapped before: with colour alone, and looking for where it is.
#include <algorithm>
#include <deque>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "devices/sim/sim_source.hpp"
#include "tests/support/recordings.hpp"
#include "vision/alignment/tracker.hpp"
#include "vision/mapping/mapper.hpp"

namespace armsreach {
namespace {

constexpr std::size_t kLate = 3;  // frames from a pose to the view that is drawn for it

std::vector<FramePtr> frames_of(const std::string& text) {
  auto kinds = real_source_kinds();
  for (SourceKind& kind : sim_source_kinds()) kinds.push_back(std::move(kind));
  auto source = open_source(*parse_source_spec(text), {}, kinds);
  EXPECT_TRUE(source) << source.error().message();
  std::vector<FramePtr> frames;
  while (auto frame = (*source)->next()) {
    if (!*frame) break;
    frames.push_back(*frame);
  }
  return frames;
}

// A world mapped while its frames were tracked with colour and depth.
struct KnownWorld {
  explicit KnownWorld(const std::vector<FramePtr>& frames) : mapper(options()) {
    Tracker tracker;
    std::deque<ReferenceViewPtr> views(kLate);
    for (const FramePtr& frame : frames) {
      const TrackedFrame tracked = tracker.track(frame, views.front());
      EXPECT_TRUE(trusted(tracked)) << frame->index;
      poses.push_back(tracked.world_from_camera);
      camera = tracked.camera;
      const ReferenceViewPtr view = mapper.process(tracked).reference;
      views.push_back(view ? view : views.back());
      views.pop_front();
    }
  }
  static mapping::MapperOptions options() {
    mapping::MapperOptions out;
    out.view_every = out.surface_every = 0;
    return out;
  }
  ReferenceViewPtr view(const Pose& pose, std::int64_t frame = 0) const {
    return mapper.reference(camera, pose, frame);
  }

  mapping::Mapper mapper;
  std::vector<Pose> poses;  // world_from_camera of the frames
  Camera camera;            // of the tracked images
};

double metres(const Pose& a, const Pose& b) { return (a.translation() - b.translation()).norm(); }

FramePtr without_depth(const FramePtr& frame) {
  auto out = std::make_shared<Frame>(*frame);
  out->depth = frame->index % 2 == 0
                   ? cv::Mat()
                   : cv::Mat(frame->depth.size(), CV_32FC1,
                             cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  return out;
}

FramePtr covered(const FramePtr& frame) {
  auto out = std::make_shared<Frame>(*frame);
  out->depth =
      cv::Mat(frame->depth.size(), CV_32FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  out->color = cv::Mat(frame->color.size(), frame->color.type(), cv::Scalar::all(2));
  return out;
}

// Greatest distance from the true path [m] of a camera that shows colour alone, tracked in a map of
// all frames, both beginning at the first camera.
double worst_by_colour_alone(const std::vector<FramePtr>& frames) {
  KnownWorld world(frames);
  TrackerOptions options;
  options.aligner.alpha = 0;
  Tracker tracker(options);
  std::deque<ReferenceViewPtr> views(kLate, world.view(Pose()));
  const Pose first_from_truth = frames[0]->world_from_camera->inverse();
  double worst = 0;
  for (const FramePtr& frame : frames) {
    const TrackedFrame tracked = tracker.track(without_depth(frame), views.front());
    EXPECT_EQ(tracked.state, TrackingState::tracking) << frame->index;
    EXPECT_FALSE(world.mapper.process(tracked).inserted);
    const Pose truth = first_from_truth * *frame->world_from_camera;
    worst = std::max(worst, metres(tracked.world_from_camera, truth));
    views.push_back(frame->index % 3 == 0 ? world.view(tracked.world_from_camera, frame->index)
                                          : views.back());
    views.pop_front();
  }
  return worst;
}

// Required are 2 cm; beside them stands what is usual.
TEST(KnownMap, ColourAloneIsTrackedInLivingroom) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  EXPECT_LT(worst_by_colour_alone(frames_of("tum:" + path.string())), 0.02);  // m
}

TEST(KnownMap, ColourAloneIsTrackedOnTheBench) {
  EXPECT_LT(worst_by_colour_alone(frames_of("sim:bench,speed=2,frames=150")), 0.02);  // m
}

// What the poses of one frame may differ by that were found when it was mapped and in the finished
// map, which has redkitchen's drift.
constexpr double kSamePlace = 0.02;  // m; 0.01

// Carried about for half a second without seeing: not far, if one looks for it.
TEST(KnownMap, ACoveredCameraFindsItselfByWhatItSawLast) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  const std::vector<FramePtr> frames = frames_of("tum:" + path.string());
  const KnownWorld world(frames);
  Tracker tracker;
  ReferenceViewPtr view;
  for (std::size_t i = 0; i < 20; ++i) {
    view = world.view(world.poses[i]);
    ASSERT_EQ(tracker.track(frames[i], view).state, TrackingState::tracking);
  }
  for (std::size_t i = 20; i < 35; ++i) {
    ASSERT_EQ(tracker.track(covered(frames[i]), view).state, TrackingState::lost) << i;
  }
  const TrackedFrame again = tracker.track(frames[35], view);
  EXPECT_EQ(again.state, TrackingState::tracking);
  EXPECT_LT(metres(again.world_from_camera, world.poses[35]), kSamePlace);
}

// A camera that knows nothing but the map, shown where it was four frames ago, and turned away from
// there by 30 deg and 0.5 m.
void find_again(const std::vector<FramePtr>& frames) {
  const KnownWorld world(frames);
  TrackerOptions anywhere;
  anywhere.start.reset();
  const Pose turned(so3_exp({0, 0.5, 0}), Eigen::Vector3d(0.5, 0, 0));
  int found = 0;
  int asked = 0;
  for (std::size_t i = 4; i < frames.size(); i += 8, ++asked) {
    Tracker tracker(anywhere);
    const TrackedFrame wrong =
        tracker.track(frames[i], nullptr, world.view(world.poses[i - 4] * turned));
    // It may find the way from there, but nowhere else.
    if (wrong.state == TrackingState::relocalised) {
      EXPECT_LT(metres(wrong.world_from_camera, world.poses[i]), kSamePlace) << i;
    }
    const TrackedFrame right = tracker.track(frames[i], nullptr, world.view(world.poses[i - 4]));
    if (right.state == TrackingState::lost) continue;
    ++found;
    EXPECT_LT(metres(right.world_from_camera, world.poses[i]), kSamePlace) << i;
    const TrackedFrame next = tracker.track(frames[i - 1], nullptr);
    EXPECT_EQ(next.state, TrackingState::tracking) << i;
    EXPECT_LT(metres(next.world_from_camera, world.poses[i - 1]), kSamePlace) << i;
  }
  EXPECT_GE(found, 0.95 * asked);
}

TEST(KnownMap, LivingroomIsFoundAgain) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  find_again(frames_of("tum:" + path.string()));
}

TEST(KnownMap, RedkitchenIsFoundAgain) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  find_again(frames_of("tum:" + path.string()));
}

TEST(KnownMap, AnotherRoomIsNotBelieved) {
  ARMSREACH_RECORDING_OR_SKIP(room, "rgbd/livingroom");
  ARMSREACH_RECORDING_OR_SKIP(kitchen, "rgbd/redkitchen");
  const std::vector<FramePtr> known = frames_of("tum:" + room.string());
  const std::vector<FramePtr> other = frames_of("tum:" + kitchen.string());
  for (const auto& [mapped, shown] : {std::pair(known, other), std::pair(other, known)}) {
    const KnownWorld world(mapped);
    TrackerOptions anywhere;
    anywhere.start.reset();
    Tracker tracker(anywhere);
    for (std::size_t i = 0; i < 90; i += 3) {
      const ReferenceViewPtr proposed = world.view(world.poses[i]);
      EXPECT_EQ(tracker.track(shown[i], nullptr, proposed).state, TrackingState::lost) << i;
    }
  }
}

}  // namespace
}  // namespace armsreach
