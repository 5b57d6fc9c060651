// The tracker's step, downsampling from 640x480 included, beside the odometries of cv::rgbd at
// 640x480 on the same frames, all on one thread. Run with --benchmark_enable_random_interleaving
// and a few repetitions to interleave them.
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/rgbd.hpp>

#include "tests/support/synthetic_room.hpp"
#include "vision/alignment/tracker.hpp"
#include "vision/core/pyramid.hpp"

namespace armsreach {
namespace {

// A hand-held sweep to and fro with a Kinect's noise.
const std::vector<FramePtr>& frames() {
  static const std::vector<FramePtr> made = [] {
    test::SyntheticRoom room;
    room.depth_noise = 1.425e-3;
    room.intensity_noise = 0.01;
    const auto sensor = test::synthetic_sensor();
    Vector6d step;
    step << 0.008, 0.002, 0.004, 0.002, 0.006, 0.001;
    std::vector<FramePtr> out;
    for (int i = 0; i < 16; ++i) {
      out.push_back(room.frame(sensor, Pose::exp((i < 8 ? i : 16 - i) * step), i));
    }
    return out;
  }();
  return made;
}

void tracker_step(benchmark::State& state, int width, bool map) {
  TrackerOptions options;
  options.width = width;
  Tracker tracker(options);
  TrackedFrame last = tracker.track(frames()[0], nullptr);
  std::size_t i = 1;
  for (auto _ : state) {
    // A new view every frame, as from a map: one more pyramid to build than from frame to frame.
    ReferenceViewPtr view;
    if (map) {
      view = std::make_shared<ReferenceView>(ReferenceView{
          last.camera, last.world_from_camera, last.depth, last.intensity, last.frame->index});
    }
    last = tracker.track(frames()[i++ % frames().size()], view);
    if (last.state != TrackingState::tracking) state.SkipWithError("lost");
  }
}

void peer(benchmark::State& state, const cv::Ptr<cv::rgbd::Odometry>& odometry) {
  const Camera& camera = *frames()[0]->sensor->depth_camera;
  odometry->setCameraMatrix(
      (cv::Mat_<float>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1));
  std::size_t i = 1;
  const auto frame = [](std::size_t at) {
    const Frame& f = *frames()[at % frames().size()];
    return cv::rgbd::OdometryFrame::create(f.color, f.depth, cv::Mat(), cv::Mat(), -1);
  };
  auto last = frame(0);
  for (auto _ : state) {
    auto now = frame(i++);
    cv::Mat motion;
    if (!odometry->compute(last, now, motion)) state.SkipWithError("no motion found");
    last = now;
  }
}

void reduction(benchmark::State& state, int factor) {
  std::size_t i = 0;
  for (auto _ : state) {
    const Frame& frame = *frames()[i++ % frames().size()];
    benchmark::DoNotOptimize(reduced_depth(frame.depth, factor).data);
    benchmark::DoNotOptimize(reduced_intensity(frame.color, factor).data);
  }
}

// One alignment at 80x60 for each level of instructions.
void aligner(benchmark::State& state, Isa isa) {
  if (isa > best_isa()) return state.SkipWithError("not on this processor");
  const Camera camera = resized(*frames()[0]->sensor->depth_camera, 80, 60);
  Pyramid reference, now;
  for (int i = 0; i < 2; ++i) {
    (i == 0 ? reference : now)
        .assign(camera, reduced_depth(frames()[i]->depth, 8),
                reduced_intensity(frames()[i]->color, 8), 1);
  }
  Aligner aligner({.alpha = 0.95, .iterations = {5}}, isa);
  for (auto _ : state) benchmark::DoNotOptimize(aligner.align(now, reference, Pose()).inliers);
}

#define ARMSREACH_BENCH(...) BENCHMARK_CAPTURE(__VA_ARGS__)->Unit(benchmark::kMillisecond)
ARMSREACH_BENCH(tracker_step, to_80x60_frame_to_frame, 80, false);
ARMSREACH_BENCH(tracker_step, to_80x60_against_views, 80, true);
ARMSREACH_BENCH(tracker_step, to_160x120_against_views, 160, true);
ARMSREACH_BENCH(peer, RgbdOdometry_640x480, cv::rgbd::RgbdOdometry::create());
ARMSREACH_BENCH(peer, ICPOdometry_640x480, cv::rgbd::ICPOdometry::create());
ARMSREACH_BENCH(peer, RgbdICPOdometry_640x480, cv::rgbd::RgbdICPOdometry::create());
ARMSREACH_BENCH(reduction, to_80x60, 8);
ARMSREACH_BENCH(reduction, to_160x120, 4);
ARMSREACH_BENCH(aligner, 80x60_baseline, Isa::baseline);
ARMSREACH_BENCH(aligner, 80x60_v3, Isa::v3);
ARMSREACH_BENCH(aligner, 80x60_v4, Isa::v4);

}  // namespace
}  // namespace armsreach
