// How often each colour occurs among the pixels of a class: the U,V plane of BT.601 in full range,
// and beside it the brightness, taken as independent of U and V.
#pragma once

#include <array>
#include <vector>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>

namespace armsreach::gesture {

struct Yuv {
  int y, u, v;  // 0..255; grey has u = v = 128
};

// BT.601, full range, in integers.
inline Yuv yuv_from_bgr(int b, int g, int r) {
  const int y = (29 * b + 150 * g + 77 * r + 128) >> 8;
  return {y, 128 + (((b - y) * 144 + 128) >> 8), 128 + (((r - y) * 183 + 128) >> 8)};
}

class ColorHistogram {
 public:
  static constexpr int kSide = 64;   // cells along U and along V
  static constexpr int kLumas = 32;  // cells of brightness

  void add(const Yuv& color, double weight = 1);
  void add_cell(int u, int v, double weight);  // cells 0..kSide-1
  void add_luma(int luma, double weight);      // cell 0..kLumas-1
  // The other's pixels, as many as `weight` says in all.
  void add_share(const ColorHistogram& other, double weight);

  double count() const { return count_; }  // pixels
  bool empty() const { return count_ <= 0; }
  double cell(int u, int v) const { return uv_[v * kSide + u]; }
  double luma(int luma) const { return luma_[luma]; }

 private:
  std::vector<double> uv_ = std::vector<double>(kSide * kSide);  // row v, column u
  std::array<double, kLumas> luma_{};
  double count_ = 0;
};

// Adds the pixels of a CV_8UC3 BGR image where the CV_8UC1 mask is not 0 (an empty mask: all).
void add_pixels(const cv::Mat& bgr, const cv::Mat& mask, ColorHistogram* histogram);

// p(c|C): the histogram smoothed, with a small even share for colours that never occurred.
struct ColorLikelihood {
  explicit ColorLikelihood(const ColorHistogram& histogram);
  double operator()(const Yuv& color, bool with_luma) const;

  cv::Mat1f uv;                                    // kSide x kSide, sums to 1
  std::array<float, ColorHistogram::kLumas> luma;  // sums to 1
};

}  // namespace armsreach::gesture
