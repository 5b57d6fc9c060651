// The tracker's step, reduction of its input included, beside the odometries of cv::rgbd on the
// same frames, all on one thread. The two take turns frame by frame, so that their ratio holds on a
// busy machine.
#include <ctime>
#include <memory>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/rgbd.hpp>

#include "tests/support/synthetic_room.hpp"
#include "vision/alignment/tracker.hpp"
#include "vision/core/pyramid.hpp"

namespace armsreach {
namespace {

// A hand-held sweep to and fro over a table with a Kinect's noise, by a camera of this width.
std::vector<FramePtr> sweep(int width) {
  test::SyntheticRoom room;
  room.depth_noise = 1.425e-3;
  room.intensity_noise = 0.01;
  const auto sensor = test::synthetic_sensor(width);
  const Pose start(so3_exp({-0.25, 0.1, 0}), Eigen::Vector3d(0, -0.5, 0.3));
  Vector6d step;
  step << 0.008, 0.002, 0.004, 0.002, 0.006, 0.001;
  std::vector<FramePtr> out;
  for (int i = 0; i < 16; ++i) {
    out.push_back(room.frame(sensor, start * Pose::exp((i < 8 ? i : 16 - i) * step), i));
  }
  return out;
}
const std::vector<FramePtr>& frames() {
  static const std::vector<FramePtr> made = sweep(640);
  return made;
}

// Tracks against a new view every frame, as from a map: one more pyramid to build than from frame
// to frame.
class OurStep {
 public:
  explicit OurStep(int width) : tracker_(options(width)) {}
  bool operator()(const FramePtr& frame) {
    ReferenceViewPtr view;
    if (last_.frame) {
      view = std::make_shared<ReferenceView>(ReferenceView{
          last_.camera, last_.world_from_camera, last_.depth, last_.intensity, last_.frame->index});
    }
    last_ = tracker_.track(frame, view);
    return last_.state != TrackingState::lost;
  }

 private:
  static TrackerOptions options(int width) {
    TrackerOptions out;
    out.width = width;
    return out;
  }
  Tracker tracker_;
  TrackedFrame last_;
};

class PeerStep {
 public:
  PeerStep(cv::Ptr<cv::rgbd::Odometry> odometry, const Camera& camera)
      : odometry_(std::move(odometry)) {
    odometry_->setCameraMatrix(
        (cv::Mat_<float>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1));
  }
  bool operator()(const FramePtr& frame) {
    auto now =
        cv::rgbd::OdometryFrame::create(frame->color, frame->depth, cv::Mat(), cv::Mat(), -1);
    cv::Mat motion;
    const bool found = !last_ || odometry_->compute(last_, now, motion);
    last_ = now;
    return found;
  }

 private:
  cv::Ptr<cv::rgbd::Odometry> odometry_;
  cv::Ptr<cv::rgbd::OdometryFrame> last_;
};

void tracker_step(benchmark::State& state, int width) {
  OurStep step(width);
  std::size_t i = 0;
  step(frames()[i++]);
  for (auto _ : state) {
    if (!step(frames()[i++ % frames().size()])) state.SkipWithError("lost");
  }
}

// Input images of one width, tracked by us at another.
void odometry_beside(benchmark::State& state, const cv::Ptr<cv::rgbd::Odometry>& odometry,
                     int input, int ours_at) {
  const std::vector<FramePtr> images = sweep(input);
  OurStep ours(ours_at);
  PeerStep peer(odometry, *images[0]->sensor->depth_camera);
  ours(images[0]);
  peer(images[0]);
  // Of the processor: both run on this thread alone.
  const auto timed = [](auto& step, const FramePtr& frame, std::clock_t& spent, const char* lost,
                        benchmark::State& run) {
    const std::clock_t start = std::clock();
    if (!step(frame)) run.SkipWithError(lost);
    spent += std::clock() - start;
  };
  std::clock_t our_time = 0;
  std::clock_t peer_time = 0;
  std::size_t i = 1;
  for (auto _ : state) {
    const FramePtr& frame = images[i++ % images.size()];
    // Who comes first finds the frame cold.
    if (i % 2 == 0) timed(ours, frame, our_time, "ours is lost", state);
    timed(peer, frame, peer_time, "the peer finds no motion", state);
    if (i % 2 != 0) timed(ours, frame, our_time, "ours is lost", state);
  }
  const double per_step = 1e3 / CLOCKS_PER_SEC / static_cast<double>(state.iterations());
  state.counters["ours_ms"] = per_step * static_cast<double>(our_time);
  state.counters["peer_ms"] = per_step * static_cast<double>(peer_time);
  state.counters["ratio"] = static_cast<double>(peer_time) / static_cast<double>(our_time);
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
ARMSREACH_BENCH(tracker_step, from_640x480_to_80x60, 80);
ARMSREACH_BENCH(tracker_step, from_640x480_to_160x120, 160);
#define ARMSREACH_BESIDE(peer, input, ours_at)                            \
  ARMSREACH_BENCH(odometry_beside, peer##_at_##input##_ours_to_##ours_at, \
                  cv::rgbd::peer::create(), input, ours_at)               \
      ->Iterations(32)
ARMSREACH_BESIDE(RgbdOdometry, 80, 80);
ARMSREACH_BESIDE(RgbdOdometry, 160, 80);
ARMSREACH_BESIDE(RgbdOdometry, 320, 80);
ARMSREACH_BESIDE(RgbdOdometry, 640, 80);
ARMSREACH_BESIDE(RgbdOdometry, 640, 160);
ARMSREACH_BESIDE(ICPOdometry, 80, 80);
ARMSREACH_BESIDE(ICPOdometry, 160, 80);
ARMSREACH_BESIDE(ICPOdometry, 320, 80);
ARMSREACH_BESIDE(ICPOdometry, 640, 80);
ARMSREACH_BESIDE(RgbdICPOdometry, 80, 80);
ARMSREACH_BESIDE(RgbdICPOdometry, 160, 80);
ARMSREACH_BESIDE(RgbdICPOdometry, 320, 80);
ARMSREACH_BESIDE(RgbdICPOdometry, 640, 80);
ARMSREACH_BENCH(reduction, to_80x60, 8);
ARMSREACH_BENCH(reduction, to_160x120, 4);
ARMSREACH_BENCH(aligner, 80x60_baseline, Isa::baseline);
ARMSREACH_BENCH(aligner, 80x60_v3, Isa::v3);
ARMSREACH_BENCH(aligner, 80x60_v4, Isa::v4);

}  // namespace
}  // namespace armsreach
