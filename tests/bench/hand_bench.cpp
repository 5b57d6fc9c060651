// What a simulated hand costs: meshing a person once, posing the skin, drawing it, and one
// silhouette of a bank of templates.
#include <benchmark/benchmark.h>

#include "devices/sim/hand/gesture.hpp"
#include "devices/sim/hand/hand_painter.hpp"
#include "devices/sim/hand/silhouette.hpp"

namespace {

using namespace armsreach;
using namespace armsreach::sim;

void BM_HandMesh(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(HandSurface(mean_anatomy(), {}));
}
BENCHMARK(BM_HandMesh)->Unit(benchmark::kMillisecond);

void BM_HandGestureByContact(benchmark::State& state) {
  const HandAnatomy anatomy = mean_anatomy();
  for (auto _ : state) benchmark::DoNotOptimize(pose_of(Gesture::six, anatomy));
}
BENCHMARK(BM_HandGestureByContact)->Unit(benchmark::kMillisecond);

// The skin of one frame: the budget is 3 ms.
void BM_HandPose(benchmark::State& state) {
  const HandSurface surface(mean_anatomy(), {});
  const HandSkeleton skeleton =
      skeleton_of(surface.anatomy(), pose_of(Gesture::grasp, surface.anatomy()));
  PosedSurface posed;
  for (auto _ : state) {
    surface.pose(skeleton, posed);
    benchmark::DoNotOptimize(posed.positions.data());
  }
}
BENCHMARK(BM_HandPose)->Unit(benchmark::kMillisecond);

// All of one frame, the hand half a metre away.
void BM_HandFrame(benchmark::State& state) {
  HandDescription hand;
  hand.keys.resize(2);
  for (HandKey& key : hand.keys) key.at = {0, 0, 0.5};
  hand.keys[1].time = 1;
  hand.keys[1].gesture = Gesture::fist;
  HandPainter painter({hand});
  const int width = static_cast<int>(state.range(0));
  Raster raster(
      pinhole(width, width * 3 / 4, 0.8 * width, 0.8 * width, 0.5 * width, 0.375 * width));
  double time = 0;
  for (auto _ : state) {
    painter.set_time(time, {});
    benchmark::DoNotOptimize(painter.draw(raster, {}, {}));
    time = time < 1 ? time + 0.03 : 0;
  }
}
BENCHMARK(BM_HandFrame)->Arg(320)->Arg(640)->Unit(benchmark::kMillisecond);

void BM_HandSilhouette(benchmark::State& state) {
  HandSurfaceOptions options;
  options.forearm = 0.03;
  options.cell = 0.004;
  const HandSurface surface(mean_anatomy(), options);
  const HandPose pose = pose_of(Gesture::open, surface.anatomy());
  SilhouetteCamera camera(160);
  for (auto _ : state) benchmark::DoNotOptimize(camera.draw(surface, pose, {}));
}
BENCHMARK(BM_HandSilhouette)->Unit(benchmark::kMillisecond);

}  // namespace
