#include "vision/core/pyramid.hpp"

#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

namespace armsreach {
namespace {

constexpr float kSameSurface = 1.03F;  // samples up to 3 % behind the nearest are one surface

float reduced_block(const cv::Mat& depth, int row0, int col0, int factor) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  float nearest = std::numeric_limits<float>::infinity();
  int known = 0;
  for (int row = row0; row < row0 + factor; ++row) {
    const float* line = depth.ptr<float>(row) + col0;
    for (int i = 0; i < factor; ++i) {
      if (!(line[i] > 0)) continue;
      nearest = std::min(nearest, line[i]);
      ++known;
    }
  }
  if (known == 0 || 4 * known < factor * factor) return kUnknown;
  const float limit = nearest * kSameSurface;
  float sum = 0;
  int count = 0;
  for (int row = row0; row < row0 + factor; ++row) {
    const float* line = depth.ptr<float>(row) + col0;
    for (int i = 0; i < factor; ++i) {
      if (!(line[i] <= limit && line[i] > 0)) continue;
      sum += line[i];
      ++count;
    }
  }
  return sum / static_cast<float>(count);
}

}  // namespace

cv::Mat reduced_depth(const cv::Mat& depth, int factor) {
  CV_Assert(depth.type() == CV_32FC1 && factor >= 1);
  cv::Mat reduced(depth.rows / factor, depth.cols / factor, CV_32FC1);
  for (int row = 0; row < reduced.rows; ++row) {
    float* line = reduced.ptr<float>(row);
    for (int col = 0; col < reduced.cols; ++col) {
      line[col] = reduced_block(depth, row * factor, col * factor, factor);
    }
  }
  return reduced;
}

cv::Mat reduced_intensity(const cv::Mat& image, int factor) {
  CV_Assert(image.depth() == CV_8U && factor >= 1);
  const cv::Size size(image.cols / factor, image.rows / factor);
  const cv::Mat whole_blocks = image(cv::Rect(0, 0, size.width * factor, size.height * factor));
  cv::Mat small;
  cv::resize(whole_blocks, small, size, 0, 0, cv::INTER_AREA);
  if (small.channels() == 3) cv::cvtColor(small, small, cv::COLOR_BGR2GRAY);
  cv::Mat intensity;
  small.convertTo(intensity, CV_32F, 1.0 / 255);
  return intensity;
}

}  // namespace armsreach
