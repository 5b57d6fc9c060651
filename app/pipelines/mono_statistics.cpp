#include "app/pipelines/mono_statistics.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace armsreach::app {
namespace {

constexpr double kBin = 0.02;  // px

const char* name(mono_slam::ScaleFrom scale) {
  switch (scale) {
    case mono_slam::ScaleFrom::nothing_yet:
      return "nothing yet";
    case mono_slam::ScaleFrom::target:
      return "target";
    case mono_slam::ScaleFrom::depth:
      return "depth";
    case mono_slam::ScaleFrom::stated:
      return "stated";
    case mono_slam::ScaleFrom::map:
      return "map";
  }
  return "";
}

}  // namespace

void PixelHistogram::add(double pixels) {
  const int bin = static_cast<int>(std::min(pixels / kBin, kBins - 1.0));
  ++bins_[static_cast<std::size_t>(std::max(bin, 0))];
  ++count_;
}

double PixelHistogram::quantile(double share) const {
  if (count_ == 0) return 0;
  const double wanted = share * static_cast<double>(count_);
  std::int64_t below = 0;
  int bin = 0;
  for (; bin < kBins - 1; ++bin) {
    below += bins_[static_cast<std::size_t>(bin)];
    if (static_cast<double>(below) >= wanted) break;
  }
  return (bin + 0.5) * kBin;
}

void MonoStatistics::Mean::add(double value) {
  least = count == 0 ? value : std::min(least, value);
  sum += value;
  ++count;
}

void MonoStatistics::add(const mono_slam::MonoResult& result) {
  ++frames_;
  scale_ = result.scale;
  trace_ = result.trace;
  if (result.state == TrackingState::lost) {
    ++lost_frames_;
    if (result.state_changed) ++times_lost_;
  }
  // On the frame that it starts or goes on with, nothing has been looked for.
  if (result.state != TrackingState::tracking || result.state_changed) return;
  mapped_last_ = 0;
  for (const mono_slam::MapPoint& point : result.points) {
    if (point.kind == mono_slam::PointKind::position && !point.of_target) ++mapped_last_;
    if (point.outcome != mono_slam::Outcome::measured) continue;
    innovations_.add(point.innovation.norm());
    residuals_.add(point.residual);
    expected_.add(std::sqrt(0.5 * point.innovation_covariance.trace()));
  }
  visible_.add(result.visible);
  measured_.add(result.inliers);
  mapped_.add(mapped_last_);
}

nlohmann::json MonoStatistics::json() const {
  const auto pixels = [](const PixelHistogram& of) {
    return nlohmann::json{{"median", of.quantile(0.5)}, {"p90", of.quantile(0.9)}};
  };
  return {{"frames", frames_},
          {"lost_frames", lost_frames_},
          {"times_lost", times_lost_},
          {"scale", name(scale_)},
          {"innovation_px", pixels(innovations_)},
          {"residual_px", pixels(residuals_)},
          {"measurements", innovations_.count()},
          {"s_sigma_px", expected_.mean()},
          {"p_trace", trace_},
          {"visible", {{"mean", visible_.mean()}, {"least", visible_.least}}},
          {"measured", {{"mean", measured_.mean()}, {"least", measured_.least}}},
          {"mapped", {{"mean", mapped_.mean()}, {"last", mapped_last_}}}};
}

}  // namespace armsreach::app
