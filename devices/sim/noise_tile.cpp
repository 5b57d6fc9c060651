#include "devices/sim/noise_tile.hpp"

#include <opencv2/imgproc.hpp>

#include "devices/sim/random.hpp"

namespace armsreach::sim {
namespace {

constexpr int kRows = 512;

// The taps' norm in two directions, 0.25 + 1 + 0.25, keeps the variance.
cv::Mat smoothed(const cv::Mat& tile) {
  cv::Mat wrapped;
  cv::copyMakeBorder(tile, wrapped, 1, 1, 1, 1, cv::BORDER_WRAP);
  const cv::Matx13f taps(0.5F, 1.0F, 0.5F);
  cv::Mat smooth;
  cv::sepFilter2D(wrapped, smooth, CV_32F, taps, taps);
  return smooth(cv::Rect(1, 1, tile.cols, tile.rows)) / 1.5;
}

}  // namespace

NoiseTile::NoiseTile(int row_length, std::uint64_t seed, Kind kind) : seed_(seed) {
  Random random(seed);
  cv::Mat tile(kRows, row_length, CV_32F);
  for (int y = 0; y < tile.rows; ++y) {
    for (int x = 0; x < tile.cols; ++x) tile.at<float>(y, x) = static_cast<float>(random.normal());
  }
  if (kind == Kind::smooth) tile = smoothed(tile);
  // Rows twice over, so that reading one from anywhere in its first half never wraps.
  cv::hconcat(tile, tile, tile_);
}

const float* NoiseTile::row(std::int64_t frame, int y) const {
  const std::uint64_t key = mixed(seed_, static_cast<std::uint64_t>(frame));
  const int row = static_cast<int>((key + static_cast<std::uint64_t>(y)) % kRows);
  return tile_.ptr<float>(row) + (key >> 32) % static_cast<std::uint64_t>(tile_.cols / 2);
}

}  // namespace armsreach::sim
