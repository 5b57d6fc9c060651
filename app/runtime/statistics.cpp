#include "app/runtime/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::app {
namespace {

constexpr double kShortest = 1e-6;  // s
constexpr double kBinRatio = 1.02;

}  // namespace

void LatencyHistogram::record(double seconds) {
  const double bin = std::log(std::max(seconds, kShortest) / kShortest) / std::log(kBinRatio);
  const int index = std::clamp(static_cast<int>(bin), 0, kBins - 1);
  bins_[static_cast<size_t>(index)].fetch_add(1, std::memory_order_relaxed);
  total_ns_.fetch_add(static_cast<std::int64_t>(seconds * 1e9), std::memory_order_relaxed);
}

std::int64_t LatencyHistogram::count() const {
  std::int64_t sum = 0;
  for (const auto& bin : bins_) sum += bin.load(std::memory_order_relaxed);
  return sum;
}

double LatencyHistogram::percentile(double fraction) const {
  const std::int64_t all = count();
  if (all == 0) return 0;
  const auto wanted = static_cast<std::int64_t>(std::ceil(fraction * static_cast<double>(all)));
  std::int64_t below = 0;
  int index = 0;
  for (; index < kBins - 1; ++index) {
    below += bins_[static_cast<size_t>(index)].load(std::memory_order_relaxed);
    if (below >= wanted) break;
  }
  return kShortest * std::pow(kBinRatio, index + 0.5);
}

double LatencyHistogram::mean() const {
  const std::int64_t all = count();
  return all == 0 ? 0 : 1e-9 * static_cast<double>(total_ns_.load()) / static_cast<double>(all);
}

}  // namespace armsreach::app
