#include "vision/core/pyramid.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "vision/core/pyramid_kernels.hpp"

namespace armsreach {
namespace {

constexpr int kLeastWidth = 16;  // of the kernels
constexpr double kScatter = 6;   // deviations between the nearest and the farthest of 64 samples

}  // namespace

PyramidKernels pyramid_kernels(Isa isa) {
#ifdef __x86_64__
  if (isa == Isa::v4) return v4::kPyramidKernels;
  if (isa == Isa::v3) return v3::kPyramidKernels;
#endif
  static_cast<void>(isa);
  return baseline::kPyramidKernels;
}

cv::Mat reduced_depth(const cv::Mat& depth, int factor, double noise) {
  CV_Assert(depth.type() == CV_32FC1 && factor >= 1);
  const cv::Size size(depth.cols / factor, depth.rows / factor);
  cv::Mat image = depth;
  if (image.cols < kLeastWidth) {
    image = cv::Mat(depth.rows, kLeastWidth, CV_32FC1, cv::Scalar(0));
    depth.copyTo(image.colRange(0, depth.cols));
  }
  const int width = std::max(kLeastWidth, size.width * factor);
  const int step = static_cast<int>(image.step1());
  const PyramidKernels kernels = pyramid_kernels(best_isa());
  const auto scatter = static_cast<float>(kScatter * noise);
  std::vector<float> scratch(3 * width);
  cv::Mat reduced(size, CV_32FC1);
  std::vector<float> line(width / factor);
  for (int row = 0; row < size.height; ++row) {
    kernels.depth_row(image.ptr<float>(row * factor), step, width, factor, scatter, scratch.data(),
                      line.data());
    std::copy_n(line.data(), size.width, reduced.ptr<float>(row));
  }
  return reduced;
}

cv::Mat reduced_intensity(const cv::Mat& image, int factor) {
  CV_Assert((image.type() == CV_8UC1 || image.type() == CV_8UC3) && factor >= 1 && factor <= 256);
  const int width = image.cols / factor * factor;
  const PyramidKernels kernels = pyramid_kernels(best_isa());
  std::vector<std::uint16_t> column_sums(width * image.channels());
  std::vector<float> grey(width);
  cv::Mat reduced(image.rows / factor, image.cols / factor, CV_32FC1);
  for (int row = 0; row < reduced.rows; ++row) {
    kernels.intensity_row(image.ptr(row * factor), static_cast<int>(image.step), width,
                          image.channels(), factor, column_sums.data(), grey.data(),
                          reduced.ptr<float>(row));
  }
  return reduced;
}

}  // namespace armsreach
