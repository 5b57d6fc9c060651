// What a simulated frame costs with its noise, masks and truth, in the time of all threads. The
// goal is 60 frames a second of 320x240 on one core: under 16.7 ms of CPU.
#include <string>

#include <benchmark/benchmark.h>

#include "devices/open.hpp"
#include "devices/sim/sim_source.hpp"

namespace {

using namespace armsreach;

void BM_SimFrame(benchmark::State& state, const std::string& world) {
  const std::string spec = "sim:" + world + ",loop=endless,width=" + std::to_string(state.range(0));
  auto source = open_source(*parse_source_spec(spec), {}, sim_source_kinds());
  if (!source || !(*source)->next()) {
    state.SkipWithError("no simulated source");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize((*source)->next());
}

// Frames along the whole path, as fast as it is walked.
void in_all_sizes(benchmark::internal::Benchmark* bench) {
  bench->Arg(320)->Arg(640)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}
BENCHMARK_CAPTURE(BM_SimFrame, bench, "bench")->Apply(in_all_sizes);
BENCHMARK_CAPTURE(BM_SimFrame, near, "near")->Apply(in_all_sizes);
BENCHMARK_CAPTURE(BM_SimFrame, haptic_table, "haptic-table")->Apply(in_all_sizes);
BENCHMARK_CAPTURE(BM_SimFrame, kitchen_table, "kitchen-table")->Apply(in_all_sizes);
BENCHMARK_CAPTURE(BM_SimFrame, assembly, "assembly")->Apply(in_all_sizes);
BENCHMARK_CAPTURE(BM_SimFrame, packaging, "packaging")->Apply(in_all_sizes);
BENCHMARK_CAPTURE(BM_SimFrame, packaging_sharp, "packaging,exposure_ms=0")->Apply(in_all_sizes);

}  // namespace
