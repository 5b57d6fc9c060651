#include "vision/alignment/level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armsreach {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Mean of a 2x2 block's known samples of at least `least`; `known` of them must be there.
float block_mean(const float* upper, const float* lower, float least, int known) {
  float sum = 0;
  int count = 0;
  for (const float sample : {upper[0], upper[1], lower[0], lower[1]}) {
    if (!(sample >= least)) continue;
    sum += sample;
    ++count;
  }
  return count >= known ? sum / static_cast<float>(count) : kUnknown;
}

float nearest_in_block(const float* upper, const float* lower) {
  float nearest = 0;
  for (const float sample : {upper[0], upper[1], lower[0], lower[1]}) {
    if (sample > nearest) nearest = sample;
  }
  return nearest;
}

void central_differences(const std::vector<float>& plane, int width, int height, int stride,
                         float greatest_relative_step, std::vector<float>& along_x,
                         std::vector<float>& along_y) {
  std::fill(along_x.begin(), along_x.end(), kUnknown);
  std::fill(along_y.begin(), along_y.end(), kUnknown);
  for (int row = 1; row + 1 < height; ++row) {
    const float* centre = plane.data() + row * stride;
    const float* above = centre - stride;
    const float* below = centre + stride;
    float* x = along_x.data() + row * stride;
    float* y = along_y.data() + row * stride;
    for (int col = 1; col + 1 < width; ++col) {
      const float dx = 0.5F * (centre[col + 1] - centre[col - 1]);
      const float dy = 0.5F * (below[col] - above[col]);
      const float steepest = std::max(std::abs(dx), std::abs(dy));
      const bool smooth = steepest <= greatest_relative_step * centre[col];
      x[col] = smooth ? dx : kUnknown;
      y[col] = smooth ? dy : kUnknown;
    }
  }
}

}  // namespace

void Level::resize(const Camera& camera) {
  camera_ = camera;
  const std::size_t size = static_cast<std::size_t>(stride()) * camera.height;
  for (auto* plane : {&inverse_depth, &inverse_depth_x, &inverse_depth_y, &intensity, &intensity_x,
                      &intensity_y}) {
    plane->resize(size);
  }
}

void Level::assign(const Camera& camera, const cv::Mat& depth, const cv::Mat& grey) {
  CV_Assert(depth.empty() || depth.size() == cv::Size(camera.width, camera.height));
  CV_Assert(grey.empty() || grey.size() == cv::Size(camera.width, camera.height));
  resize(camera);
  std::fill(inverse_depth.begin(), inverse_depth.end(), kUnknown);
  std::fill(intensity.begin(), intensity.end(), kUnknown);
  for (int row = 0; row < height(); ++row) {
    float* rho = inverse_depth.data() + row * stride();
    if (!depth.empty()) {
      const float* z = depth.ptr<float>(row);
      for (int col = 0; col < width(); ++col) rho[col] = z[col] > 0 ? 1.0F / z[col] : kUnknown;
    }
    if (!grey.empty()) {
      std::copy_n(grey.ptr<float>(row), width(), intensity.data() + row * stride());
    }
  }
  differentiate();
}

void Level::assign_half(const Level& finer) {
  Camera whole_blocks = finer.camera();
  whole_blocks.width = finer.width() / 2 * 2;
  whole_blocks.height = finer.height() / 2 * 2;
  resize(resized(whole_blocks, finer.width() / 2, finer.height() / 2));
  std::fill(inverse_depth.begin(), inverse_depth.end(), kUnknown);
  std::fill(intensity.begin(), intensity.end(), kUnknown);
  for (int row = 0; row < height(); ++row) {
    const int upper = 2 * row * finer.stride();
    const int lower = upper + finer.stride();
    for (int col = 0; col < width(); ++col) {
      const float* rho_upper = finer.inverse_depth.data() + upper + 2 * col;
      const float* rho_lower = finer.inverse_depth.data() + lower + 2 * col;
      const float near = nearest_in_block(rho_upper, rho_lower);
      const int at = row * stride() + col;
      if (near > 0) inverse_depth[at] = block_mean(rho_upper, rho_lower, near / 1.03F, 1);
      intensity[at] = block_mean(finer.intensity.data() + upper + 2 * col,
                                 finer.intensity.data() + lower + 2 * col, 0, 2);
    }
  }
  differentiate();
}

void Level::differentiate() {
  constexpr float kAnyStep = 1e9F;
  central_differences(inverse_depth, width(), height(), stride(), kDiscontinuity, inverse_depth_x,
                      inverse_depth_y);
  central_differences(intensity, width(), height(), stride(), kAnyStep, intensity_x, intensity_y);
}

}  // namespace armsreach
