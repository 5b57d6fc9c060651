// Two ways to the same end, turn by turn in one process, so that what else the machine does falls
// on both alike. CPU time of this thread.
#pragma once

#include <ctime>

#include <benchmark/benchmark.h>

namespace armsreach::bench {

class Beside {
 public:
  template <class Work>
  void ours(Work work) {
    ours_ += time_of(work);
  }
  template <class Work>
  void peer(Work work) {
    peer_ += time_of(work);
  }
  // Counters ours_ms, peer_ms (of one turn) and ratio.
  void report(benchmark::State& state) const {
    const double per = 1e3 / static_cast<double>(state.iterations());
    state.counters["ours_ms"] = per * ours_;
    state.counters["peer_ms"] = per * peer_;
    state.counters["ratio"] = peer_ / ours_;
  }

 private:
  static double seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
  template <class Work>
  static double time_of(Work& work) {
    const double start = seconds();
    work();
    return seconds() - start;
  }

  double ours_ = 0;  // s
  double peer_ = 0;
};

}  // namespace armsreach::bench
