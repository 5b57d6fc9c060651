// What a picture costs, reading it back included. CPU time of the whole process: the software
// rasteriser has threads of its own.
#include <memory>

#include <benchmark/benchmark.h>

#include "render/context.hpp"
#include "render/renderer.hpp"
#include "tests/screenshot/tiny_world.hpp"

namespace armsreach::render {
namespace {

Scene bench_scene(bool with_teapot, float element) {
  Scene scene =
      test::tiny_scene(pinhole(640, 480, 520, 520, 319.5, 239.5), test::world_from_viewer());
  if (with_teapot) scene.objects = {test::standing(1, "teapot", 0.05, 0.05)};
  if (element > 0) scene.surface = test::tiny_surface(element);
  scene.tracking_state = "tracking";
  scene.stages = {{"tracker", 42, 0, 0.0007, 0.0009, 0.0012}};
  scene.messages = {{Severity::info, "teapot inserted"}};
  return scene;
}

void draw_and_read(benchmark::State& state, const RendererOptions& options, Scene scene,
                   bool changing_surface = false) {
  auto context = make_headless_context();
  if (!context) return state.SkipWithError(context.error().message().c_str());
  auto renderer = Renderer::make(**context, options);
  if (!renderer) return state.SkipWithError(renderer.error().message().c_str());
  for (int i = 0; i < 40; ++i) {  // the map's framing comes to rest
    scene.time += 1.0 / 30;
    (*renderer)->draw(scene, {});
  }
  int frame = 0;
  for (auto _ : state) {
    scene.time += 1.0 / 30;
    if (changing_surface && ++frame % 3 == 0) {
      auto next = std::make_shared<Surface>(*scene.surface);
      ++next->revision;
      next->blocks[0] = std::make_shared<const SurfaceBlock>(*next->blocks[0]);
      scene.surface = next;
    }
    (*renderer)->draw(scene, {});
    benchmark::DoNotOptimize((*renderer)->read_picture());
  }
}

void BM_RenderWearerVideoOnly(benchmark::State& state) {
  draw_and_read(state, {.width = 640, .height = 480}, bench_scene(false, 0));
}
void BM_RenderWearerWithTeapot(benchmark::State& state) {
  draw_and_read(state, {.width = 640, .height = 480}, bench_scene(true, 0));
}
void BM_RenderDeskSurfaceAtRest(benchmark::State& state) {
  draw_and_read(state, {.width = 1280, .height = 720, .layout = Layout::operator_desk},
                bench_scene(true, 0.003F));
}
void BM_RenderDeskSurfaceChanging(benchmark::State& state) {
  draw_and_read(state, {.width = 1280, .height = 720, .layout = Layout::operator_desk},
                bench_scene(true, 0.003F), true);
}
BENCHMARK(BM_RenderWearerVideoOnly)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(BM_RenderWearerWithTeapot)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(BM_RenderDeskSurfaceAtRest)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(BM_RenderDeskSurfaceChanging)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

// Reading a finished picture: what an asynchronous transfer could hide at most.
void BM_RenderReadBack(benchmark::State& state) {
  auto context = make_headless_context();
  if (!context) return state.SkipWithError(context.error().message().c_str());
  auto renderer = Renderer::make(**context, {.width = 640, .height = 480});
  if (!renderer) return state.SkipWithError(renderer.error().message().c_str());
  (*renderer)->draw(bench_scene(true, 0), {});
  (*context)->gl().Finish();
  for (auto _ : state) benchmark::DoNotOptimize((*renderer)->read_picture());
}
BENCHMARK(BM_RenderReadBack)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace armsreach::render
