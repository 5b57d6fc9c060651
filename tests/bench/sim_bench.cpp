// What a simulated frame costs, with noise, in the time of all threads.
#include <string>

#include <benchmark/benchmark.h>

#include "devices/open.hpp"
#include "devices/sim/sim_source.hpp"

namespace {

using namespace armsreach;

void BM_SimFrame(benchmark::State& state) {
  const std::string spec = "sim:bench,loop=endless,width=" + std::to_string(state.range(0));
  auto source = open_source(*parse_source_spec(spec), {}, sim_source_kinds());
  if (!source || !(*source)->next()) {
    state.SkipWithError("no simulated source");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize((*source)->next());
}
BENCHMARK(BM_SimFrame)
    ->Arg(320)
    ->Arg(640)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
