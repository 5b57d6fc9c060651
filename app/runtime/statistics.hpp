// What every stage counts: frames, drops and latencies, in constant memory.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace armsreach::app {

// Latencies from 1 us to 100 s in bins that are 2 % wide, so percentiles are good to 1 %.
// One thread records, any thread reads.
class LatencyHistogram {
 public:
  void record(double seconds);
  std::int64_t count() const;
  double percentile(double fraction) const;  // s; 0 when nothing was recorded
  double mean() const;                       // s

 private:
  static constexpr int kBins = 940;
  std::array<std::atomic<std::int64_t>, kBins> bins_{};
  std::atomic<std::int64_t> total_ns_{0};
};

struct StageStatistics {
  LatencyHistogram processing;  // of one turn, without waiting
  std::atomic<std::int64_t> frames{0};
  std::atomic<std::int64_t> drops{0};
  std::atomic<std::int64_t> faults{0};
};

}  // namespace armsreach::app
