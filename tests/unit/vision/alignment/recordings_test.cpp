// The tracker on real recordings and in the simulated world: absolute trajectory errors with and
// without a map.
#include "tests/support/recordings.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "devices/open.hpp"
#include "devices/sim/sim_source.hpp"
#include "vision/alignment/tracker.hpp"
#include "vision/core/trajectory.hpp"
#include "vision/mapping/mapper.hpp"

namespace armsreach {
namespace {

enum class Mapping { off, on };

struct Outcome {
  Trajectory estimate, truth;
  int lost = 0;
  // RMSE in cm of the first `frames`, all by default.
  double ate(std::size_t frames = 1'000'000) const {
    const auto head = [&](const Trajectory& all) {
      return Trajectory(all.begin(),
                        all.begin() + static_cast<std::ptrdiff_t>(std::min(frames, all.size())));
    };
    return 100 * trajectory_errors(head(estimate), head(truth), false)->ate_rmse;
  }
};

// Every `step`-th frame of a recording; views of the map arrive three frames late.
Outcome tracked(const SourceSpec& spec, const TrackerOptions& options, Mapping mapping,
                int step = 1) {
  auto kinds = real_source_kinds();
  for (SourceKind& kind : sim_source_kinds()) kinds.push_back(std::move(kind));
  auto source = open_source(spec, {}, kinds);
  EXPECT_TRUE(source) << source.error().message();
  Tracker tracker(options);
  mapping::MapperOptions map_options;
  map_options.view_every = map_options.surface_every = 0;
  mapping::Mapper mapper(map_options);
  std::deque<ReferenceViewPtr> views(3);
  Outcome out;
  for (int i = 0;; ++i) {
    auto frame = (*source)->next();
    EXPECT_TRUE(frame);
    if (!frame || !*frame) break;
    if (i % step != 0) continue;
    const TrackedFrame result = tracker.track(*frame, views.front());
    out.lost += result.state == TrackingState::lost ? 1 : 0;
    out.estimate.push_back({result.frame->time, result.world_from_camera});
    if (result.frame->world_from_camera) {
      out.truth.push_back({result.frame->time, *result.frame->world_from_camera});
    }
    if (mapping == Mapping::off) continue;
    ReferenceViewPtr view = mapper.process(result).reference;
    views.push_back(view ? view : views.back());
    views.pop_front();
  }
  return out;
}

Outcome tracked(const std::string& recording, const TrackerOptions& options, Mapping mapping,
                int step = 1) {
  return tracked(SourceSpec{"tum", recording, {}}, options, mapping, step);
}

TrackerOptions to_160x120() {
  TrackerOptions options;
  options.width = 160;
  return options;
}

TrackerOptions key_frames() {
  TrackerOptions options;
  options.own_reference = OwnReference::key_frame;
  return options;
}

// The bounds are what is required; beside them stands what is usual.

TEST(Recordings, LivingroomAgainstAMap) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  const Outcome coarse = tracked(path, {}, Mapping::on);
  EXPECT_EQ(coarse.lost, 0);
  EXPECT_LT(coarse.ate(), 0.3);  // cm; 0.03
  const Outcome fine = tracked(path, to_160x120(), Mapping::on);
  EXPECT_EQ(fine.lost, 0);
  EXPECT_LT(fine.ate(), 0.12);  // 0.01
  for (const int step : {2, 3}) {
    const Outcome fast = tracked(path, {}, Mapping::on, step);
    EXPECT_EQ(fast.lost, 0) << step;
    EXPECT_LT(fast.ate(), 0.3) << step;  // 0.03
  }
}

TEST(Recordings, LivingroomWithoutAMapDriftsSeveralTimesMore) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  const Outcome with = tracked(path, {}, Mapping::on);
  const Outcome without = tracked(path, {}, Mapping::off);
  EXPECT_EQ(without.lost, 0);
  EXPECT_GT(without.ate(), 4 * with.ate());                          // 0.45 against 0.03
  EXPECT_LT(tracked(path, key_frames(), Mapping::off).ate(), 0.24);  // 0.03
}

TEST(Recordings, RedkitchenAgainstAMap) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  for (const int step : {1, 2, 3}) {
    const Outcome outcome = tracked(path, {}, Mapping::on, step);
    EXPECT_EQ(outcome.lost, 0) << step;
    // The truth jumps by 3.6 cm at frame 121 and drifts: hence the two figures.
    EXPECT_LT(outcome.ate(120 / step + 1), 1.2) << step;  // 1.16
    if (step == 1) {
      EXPECT_LT(outcome.ate(), 1.99);  // 1.72; RgbdOdometry at 640x480 has 1.99
    }
  }
}

TEST(Recordings, RedkitchenWithoutAMap) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  for (const double alpha : {0.95, 1.0}) {
    TrackerOptions options;
    options.aligner.alpha = alpha;
    const Outcome outcome = tracked(path, options, Mapping::off);
    EXPECT_EQ(outcome.lost, 0);
    EXPECT_LT(outcome.ate(), 1.99) << alpha;  // 1.46 and 1.47
  }
  EXPECT_LT(tracked(path, key_frames(), Mapping::off).ate(), 1.6);  // 1.4
}

TEST(Recordings, ColourAloneIsTracked) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  TrackerOptions options;
  options.aligner.alpha = 0;
  const Outcome outcome = tracked(path, options, Mapping::on);
  EXPECT_EQ(outcome.lost, 0);
  EXPECT_LT(outcome.ate(), 2);  // 0.74
}

// Steps of 1 to 2 cm and 1.6 deg within a metre, six times a Kinect's noise.
TEST(Recordings, ANoisyCloseRangeSensorMovedFast) {
  const auto spec = parse_source_spec("sim:near,frames=300");
  for (const TrackerOptions& options : {TrackerOptions(), to_160x120()}) {
    const Outcome outcome = tracked(*spec, options, Mapping::on);
    EXPECT_EQ(outcome.lost, 0);
    EXPECT_LT(outcome.ate(), 0.5);  // 0.05 and 0.07
  }
}

// Depth that is reduced to what is nearest in its noise walks off by centimetres.
TEST(Recordings, TheSameNoiseAtArmsLength) {
  const auto spec = parse_source_spec("sim:bench,noise=6,speed=2,frames=150");
  const Outcome outcome = tracked(*spec, {}, Mapping::on);
  EXPECT_EQ(outcome.lost, 0);
  EXPECT_LT(outcome.ate(), 0.5);  // 0.13
}

}  // namespace
}  // namespace armsreach
