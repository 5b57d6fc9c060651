#pragma once

#include <cstring>

#include <opencv2/core/mat.hpp>

namespace armsreach::sim {

// Bit for bit, NaN included.
inline bool same(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y) {
    const std::size_t bytes = static_cast<std::size_t>(a.cols) * a.elemSize();
    if (std::memcmp(a.ptr(y), b.ptr(y), bytes) != 0) return false;
  }
  return true;
}

}  // namespace armsreach::sim
