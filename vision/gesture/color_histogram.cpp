#include "vision/gesture/color_histogram.hpp"

#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {
namespace {

constexpr double kSmoothing = 1;  // cells: less follows the noise of one image's pixels

}  // namespace

ColorHistogram& ColorHistogram::operator=(const ColorHistogram& other) {
  uv = other.uv.clone();
  luma = other.luma;
  return *this;
}

void ColorHistogram::add(const ColorCell& cell, float weight) {
  uv(cell.v, cell.u) += weight;
  luma[cell.luma] += weight;
}

double ColorHistogram::count() const { return cv::sum(uv)[0]; }

void add_pixels(const cv::Mat& bgr, const cv::Mat& mask, const ColorProjection& projection,
                ColorHistogram* histogram) {
  CV_Assert(bgr.type() == CV_8UC3);
  CV_Assert(mask.empty() || (mask.type() == CV_8UC1 && mask.size() == bgr.size()));
  for (int row = 0; row < bgr.rows; ++row) {
    const auto* pixels = bgr.ptr<cv::Vec3b>(row);
    const auto* wanted = mask.empty() ? nullptr : mask.ptr(row);
    for (int col = 0; col < bgr.cols; ++col) {
      if (!wanted || wanted[col]) histogram->add(projection(pixels[col]));
    }
  }
}

ColorHistogram spread(const ColorHistogram& histogram, double deviation) {
  ColorHistogram wide = histogram;
  cv::GaussianBlur(histogram.uv, wide.uv, cv::Size(), deviation, deviation, cv::BORDER_REPLICATE);
  return wide;
}

ColorHistogram blend(const ColorHistogram& a, const ColorHistogram& b, double weight) {
  if (a.empty()) weight = 1;
  if (b.empty()) weight = 0;
  const double of_a = weight < 1 ? (1 - weight) / a.count() : 0;
  const double of_b = weight > 0 ? weight / b.count() : 0;
  ColorHistogram both;
  both.uv = of_a * a.uv + of_b * b.uv;
  for (int i = 0; i < kLumas; ++i) {
    both.luma[i] = static_cast<float>(of_a) * a.luma[i] + static_cast<float>(of_b) * b.luma[i];
  }
  return both;
}

ColorLikelihood::ColorLikelihood(const ColorHistogram& histogram, double unseen) {
  const double count = histogram.count();
  const double share = count > 0 ? (1 - unseen) / count : 0;
  const double rest = count > 0 ? unseen : 1;
  cv::GaussianBlur(histogram.uv, uv, cv::Size(), kSmoothing, kSmoothing, cv::BORDER_REPLICATE);
  uv.convertTo(uv, CV_32F, share, rest / (kUvSide * kUvSide));
  cv::Mat1f lumas(1, kLumas);
  std::copy(histogram.luma.begin(), histogram.luma.end(), lumas.begin());
  cv::GaussianBlur(lumas, lumas, cv::Size(), kSmoothing, kSmoothing, cv::BORDER_REPLICATE);
  lumas.convertTo(lumas, CV_32F, share, rest / kLumas);
  std::copy(lumas.begin(), lumas.end(), luma.begin());
}

}  // namespace armsreach::gesture
