// How well a single camera is tracked, counted over a run in constant memory.
#pragma once

#include <array>
#include <cstdint>

#include <nlohmann/json_fwd.hpp>

#include "vision/mono_slam/mono_slam.hpp"

namespace armsreach::app {

// Lengths in the image, in bins of a fiftieth of a pixel.
class PixelHistogram {
 public:
  void add(double pixels);
  std::int64_t count() const { return count_; }
  double quantile(double share) const;  // px; 0 of none

 private:
  static constexpr int kBins = 1500;  // the last one is of 30 px and more
  std::array<std::int64_t, kBins> bins_{};
  std::int64_t count_ = 0;
};

class MonoStatistics {
 public:
  void add(const mono_slam::MonoResult& result);
  nlohmann::json json() const;

 private:
  struct Mean {
    void add(double value);
    double mean() const { return count ? sum / static_cast<double>(count) : 0; }
    double sum = 0;
    std::int64_t count = 0;
    double least = 0;
  };
  PixelHistogram innovations_;
  PixelHistogram residuals_;
  Mean expected_;  // deviation that S gives a pixel, px
  Mean visible_;
  Mean measured_;
  Mean mapped_;
  std::int64_t frames_ = 0;
  std::int64_t lost_frames_ = 0;
  std::int64_t times_lost_ = 0;
  double trace_ = 0;  // of P, last
  int mapped_last_ = 0;
  mono_slam::ScaleFrom scale_ = mono_slam::ScaleFrom::nothing_yet;
};

}  // namespace armsreach::app
