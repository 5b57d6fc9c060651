// Cells of colour: the U,V plane of BT.601 in full range (grey in the middle), and brightness. A
// gain for each channel comes first; since U and V are linear in the channels, it costs nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <opencv2/core/matx.hpp>

namespace armsreach::gesture {

constexpr int kUvSide = 128;  // cells along U and along V, two levels wide
constexpr int kLumas = 16;    // cells of brightness

struct ColorCell {
  int u, v, luma;
};

class ColorProjection {
 public:
  static constexpr int kShift = 16;

  explicit ColorProjection(const cv::Vec3f& gain = {1, 1, 1}) {
    constexpr double kB = 0.114, kG = 0.587, kR = 0.299;        // of Y
    constexpr double kU = 0.5 / (1 - kB), kV = 0.5 / (1 - kR);  // so that U and V reach +-127.5
    const cv::Vec3d u = {kU * (1 - kB), -kU * kG, -kU * kR};
    const cv::Vec3d v = {-kV * kB, -kV * kG, kV * (1 - kR)};
    const cv::Vec3d y = {kB, kG, kR};
    for (int i = 0; i < 3; ++i) {
      const double one = (1 << kShift) * static_cast<double>(gain[i]);
      u_[i] = rounded(one * u[i] * kUvSide / 256);
      v_[i] = rounded(one * v[i] * kUvSide / 256);
      luma_[i] = rounded(one * y[i] * kLumas / 256);
    }
  }

  ColorCell operator()(int b, int g, int r) const {
    constexpr int kMiddle = (kUvSide + 1) << (kShift - 1);  // grey in the middle of its cell
    const auto cell = [&](const std::array<std::int32_t, 3>& c, int offset, int cells) {
      return std::clamp((c[0] * b + c[1] * g + c[2] * r + offset) >> kShift, 0, cells - 1);
    };
    return {cell(u_, kMiddle, kUvSide), cell(v_, kMiddle, kUvSide), cell(luma_, 0, kLumas)};
  }
  ColorCell operator()(const cv::Vec3b& bgr) const { return (*this)(bgr[0], bgr[1], bgr[2]); }

 private:
  static std::int32_t rounded(double x) { return static_cast<std::int32_t>(std::lround(x)); }

  std::array<std::int32_t, 3> u_, v_, luma_;  // of B, G, R, in 2^-kShift cells
};

}  // namespace armsreach::gesture
