#include "vision/mono_slam/search_image.hpp"

#include <algorithm>
#include <cmath>

#include "vision/mono_slam/search_kernels.hpp"

namespace armsreach::mono_slam {
namespace {

void resize(SearchImage::Level* level, int width, int height) {
  level->width = width;
  level->height = height;
  level->stride = width + 2 * kPlacesAbreast;
  level->samples.resize(static_cast<std::size_t>(level->stride * (height + 1)), 0.0F);
}

void halve(const SearchImage::Level& full, SearchImage::Level* half) {
  resize(half, full.width / 2, full.height / 2);
  std::vector<float> columns(static_cast<std::size_t>(full.width) + 1);
  for (int y = 0; y < half->height; ++y) {
    const float* const middle = full.at(0, 2 * y);
    const float* const above = full.at(0, std::max(2 * y - 1, 0));
    const float* const below = full.at(0, std::min(2 * y + 1, full.height - 1));
    // Column 0 stands for the one beyond the edge.
    for (int x = 0; x < full.width; ++x) {
      columns[static_cast<std::size_t>(x) + 1] = above[x] + 2 * middle[x] + below[x];
    }
    columns[0] = columns[1];
    float* const out = half->samples.data() + y * half->stride;
    for (int x = 0; x < half->width; ++x) {
      const float* const c = columns.data() + 2 * x;
      out[x] = std::floor((c[0] + 2 * c[1] + c[2] + 8) / 16);
    }
  }
}

}  // namespace

void SearchImage::set(const cv::Mat& grey) {
  CV_Assert(grey.type() == CV_8UC1);
  resize(&full_, grey.cols, grey.rows);
  for (int y = 0; y < grey.rows; ++y) {
    const auto* const line = grey.ptr<unsigned char>(y);
    float* const out = full_.samples.data() + y * full_.stride;
    for (int x = 0; x < grey.cols; ++x) out[x] = line[x];
  }
  halve(full_, &half_);
}

}  // namespace armsreach::mono_slam
