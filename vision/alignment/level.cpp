#include "vision/alignment/level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vision/alignment/level_kernels.hpp"

namespace armsreach {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kSameSurface = 1 / 1.03F;  // inverse depths of one surface, beside the nearest
constexpr float kAnyStep = 1e9F;
constexpr int kLeastSide = 8;       // px of a level that can still tell anything
constexpr int kNoiseSamples = 256;  // pixels that stand for all where noise is assessed
// A second difference has 6 times a pixel's variance: three deviations of it, beside the noise.
constexpr double kBendOfNoise = 7.3;
constexpr int kSlack = 32;  // floats that the kernels may read beyond a plane

void copy_rows(const cv::Mat& image, int stride, std::vector<float>& plane) {
  std::fill(plane.begin(), plane.end(), kUnknown);
  for (int row = 0; row < image.rows; ++row) {
    std::copy_n(image.ptr<float>(row), image.cols, plane.data() + row * stride);
  }
}

}  // namespace

LevelKernels level_kernels(Isa isa) {
#ifdef __x86_64__
  if (isa == Isa::v4) return v4::kLevelKernels;
  if (isa == Isa::v3) return v3::kLevelKernels;
#endif
  static_cast<void>(isa);
  return baseline::kLevelKernels;
}

void Level::resize(const Camera& camera) {
  CV_Assert(camera.width >= 3 && camera.height >= 3);
  camera_ = camera;
  const std::size_t size = static_cast<std::size_t>(stride()) * camera.height + kSlack;
  for (auto* plane : {&inverse_depth, &inverse_depth_x, &inverse_depth_y, &intensity, &intensity_x,
                      &intensity_y}) {
    plane->resize(size, kUnknown);
  }
}

void Level::assign(const Camera& camera, const cv::Mat& depth, const cv::Mat& grey) {
  CV_Assert(depth.empty() || depth.size() == cv::Size(camera.width, camera.height));
  CV_Assert(grey.empty() || grey.size() == cv::Size(camera.width, camera.height));
  resize(camera);
  has_depth_ = !depth.empty();
  copy_rows(depth, stride(), inverse_depth);
  copy_rows(grey, stride(), intensity);
  level_kernels(best_isa()).invert(inverse_depth.data(), stride() * height());
  differentiate();
}

void Level::assign_half(const Level& finer) {
  Camera whole_blocks = finer.camera();
  whole_blocks.width = finer.width() / 2 * 2;
  whole_blocks.height = finer.height() / 2 * 2;
  resize(resized(whole_blocks, finer.width() / 2, finer.height() / 2));
  has_depth_ = finer.has_depth();
  const LevelKernels kernels = level_kernels(best_isa());
  kernels.halve(finer.inverse_depth.data(), finer.stride(), kSameSurface, 1, inverse_depth.data(),
                width(), height(), stride());
  kernels.halve(finer.intensity.data(), finer.stride(), 0, 2, intensity.data(), width(), height(),
                stride());
  differentiate();
}

// The Laplacian vanishes on planes, and has 20 times a pixel's variance.
double Level::pixel_noise(const std::vector<float>& plane) {
  const int row = stride();
  const int size = row * height();
  const int step = size / kNoiseSamples | 1;
  laplacians_.clear();
  for (int at = row; at < size - row; at += step) {
    laplacians_.push_back(4 * plane[at] - plane[at - 1] - plane[at + 1] - plane[at - row] -
                          plane[at + row]);
  }
  return robust_scale_(laplacians_, 1).scale / std::sqrt(20.0);
}

void Level::differentiate() {
  depth_noise_ = pixel_noise(inverse_depth);
  intensity_noise_ = pixel_noise(intensity);
  const auto bend_of_noise = static_cast<float>(kBendOfNoise * depth_noise_);
  const LevelKernels kernels = level_kernels(best_isa());
  kernels.differentiate(inverse_depth.data(), width(), height(), stride(), greatest_step(),
                        greatest_bend(), bend_of_noise, inverse_depth_x.data(),
                        inverse_depth_y.data());
  kernels.differentiate(intensity.data(), width(), height(), stride(), kAnyStep, kAnyStep, 0,
                        intensity_x.data(), intensity_y.data());
}

void Pyramid::assign(const Camera& camera, const cv::Mat& depth, const cv::Mat& intensity,
                     int levels) {
  const int side = std::min(camera.width, camera.height);
  while (levels > 1 && side >> (levels - 1) < kLeastSide) --levels;
  levels_.resize(levels);
  levels_[0].assign(camera, depth, intensity);
  for (int i = 1; i < levels; ++i) levels_[i].assign_half(levels_[i - 1]);
}

}  // namespace armsreach
