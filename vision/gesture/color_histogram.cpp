#include "vision/gesture/color_histogram.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {
namespace {

constexpr int kSide = ColorHistogram::kSide;
constexpr int kLumas = ColorHistogram::kLumas;
constexpr double kSmoothing = 1.0;     // cells, deviation: 4 levels of U or V
constexpr double kUnseenShare = 0.01;  // of the probability, spread evenly over all colours

int cell_of(int level, int cells) { return std::clamp(level * cells / 256, 0, cells - 1); }

}  // namespace

void ColorHistogram::add(const Yuv& color, double weight) {
  uv_[cell_of(color.v, kSide) * kSide + cell_of(color.u, kSide)] += weight;
  luma_[cell_of(color.y, kLumas)] += weight;
  count_ += weight;
}

void ColorHistogram::add_cell(int u, int v, double weight) {
  uv_[v * kSide + u] += weight;
  count_ += weight;
}

void ColorHistogram::add_luma(int luma, double weight) { luma_[luma] += weight; }

void ColorHistogram::add_share(const ColorHistogram& other, double weight) {
  if (other.empty()) return;
  const double scale = weight / other.count_;
  for (std::size_t i = 0; i < uv_.size(); ++i) uv_[i] += scale * other.uv_[i];
  for (std::size_t i = 0; i < luma_.size(); ++i) luma_[i] += scale * other.luma_[i];
  count_ += weight;
}

void add_pixels(const cv::Mat& bgr, const cv::Mat& mask, ColorHistogram* histogram) {
  CV_Assert(bgr.type() == CV_8UC3);
  CV_Assert(mask.empty() || (mask.type() == CV_8UC1 && mask.size() == bgr.size()));
  for (int row = 0; row < bgr.rows; ++row) {
    const auto* pixels = bgr.ptr<cv::Vec3b>(row);
    const auto* wanted = mask.empty() ? nullptr : mask.ptr(row);
    for (int col = 0; col < bgr.cols; ++col) {
      if (wanted && !wanted[col]) continue;
      histogram->add(yuv_from_bgr(pixels[col][0], pixels[col][1], pixels[col][2]));
    }
  }
}

ColorLikelihood::ColorLikelihood(const ColorHistogram& histogram) : uv(kSide, kSide, 0.0F) {
  const double scale = histogram.empty() ? 0 : 1 / histogram.count();
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) uv(v, u) = static_cast<float>(scale * histogram.cell(u, v));
  }
  cv::GaussianBlur(uv, uv, cv::Size(), kSmoothing, kSmoothing, cv::BORDER_REPLICATE);
  cv::Mat1f lumas(1, kLumas);
  for (int i = 0; i < kLumas; ++i) lumas(i) = static_cast<float>(scale * histogram.luma(i));
  cv::GaussianBlur(lumas, lumas, cv::Size(), kSmoothing, kSmoothing, cv::BORDER_REPLICATE);
  const double share = histogram.empty() ? 1 : kUnseenShare;
  uv = uv * (1 - share) + share / (kSide * kSide);
  lumas = lumas * (1 - share) + share / kLumas;
  std::copy_n(lumas.begin(), kLumas, luma.begin());
}

double ColorLikelihood::operator()(const Yuv& color, bool with_luma) const {
  const double chroma = static_cast<double>(uv(cell_of(color.v, kSide), cell_of(color.u, kSide)));
  if (!with_luma) return chroma;
  return chroma * static_cast<double>(luma[cell_of(color.y, kLumas)]);
}

}  // namespace armsreach::gesture
