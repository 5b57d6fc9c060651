#include "vision/alignment/sensor_noise.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace armsreach {
namespace {

constexpr int kImages = 30;
constexpr int kSamplesAcross = 40;  // places looked at in a row
constexpr int kApart = 4;           // px: the errors of neighbours are alike
constexpr std::size_t kLeastSamples = 100;
// Inverse depth is linear on planes, so that its second difference is noise of 6 k^2; but for edges
// and bends, which are the greatest fifth. The rest is averaged, since the median of depth in steps
// is one of the steps. The mean magnitude of a normal deviate below its 80 % quantile is 0.5586.
constexpr double kSmooth = 0.8;
constexpr double kMeanBelow = 0.5586;

}  // namespace

void SensorNoise::learn(const cv::Mat& depth) {
  if (depth.empty() || images_ == kImages) return;
  const int step = std::max(1, depth.cols / kSamplesAcross);
  differences_.clear();
  for (int row = step / 2; row < depth.rows; row += step) {
    const float* line = depth.ptr<float>(row);
    for (int col = kApart; col + kApart < depth.cols; col += step) {
      const float difference =
          std::abs(1 / line[col - kApart] - 2 / line[col] + 1 / line[col + kApart]);
      if (std::isfinite(difference)) differences_.push_back(difference);
    }
  }
  if (differences_.size() < kLeastSamples) return;
  const auto smooth =
      static_cast<std::ptrdiff_t>(kSmooth * static_cast<double>(differences_.size()));
  std::nth_element(differences_.begin(), differences_.begin() + smooth, differences_.end());
  const double mean = std::accumulate(differences_.begin(), differences_.begin() + smooth, 0.0) /
                      static_cast<double>(smooth);
  const double k = mean / (kMeanBelow * std::sqrt(6.0));
  k_ = images_ == 0 ? k : k_ + (k - k_) / (images_ + 1);
  ++images_;
}

}  // namespace armsreach
