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

// In 16-bit integers throughout, eight pixels to a vector of the baseline: the upper half of a
// level scaled by 2^7 times a coefficient scaled by 2^15 is in 2^-6 cells.
class ColorProjection {
 public:
  explicit ColorProjection(const cv::Vec3f& gain = {1, 1, 1}) {
    constexpr double kB = 0.114, kG = 0.587, kR = 0.299;        // of Y
    constexpr double kU = 0.5 / (1 - kB), kV = 0.5 / (1 - kR);  // so that U and V reach +-127.5
    constexpr double kUv = kUvSide / 256.0, kLuma = kLumas / 256.0;
    u_ = fixed(cv::Vec3d(kU * (1 - kB), -kU * kG, -kU * kR) * kUv, gain);
    v_ = fixed(cv::Vec3d(-kV * kB, -kV * kG, kV * (1 - kR)) * kUv, gain);
    luma_ = fixed(cv::Vec3d(kB, kG, kR) * kLuma, gain);
  }

  static std::int16_t scaled(std::uint8_t level) { return static_cast<std::int16_t>(level << 7); }

  // Cells of scaled levels.
  std::int16_t u(std::int16_t b, std::int16_t g, std::int16_t r) const {
    return cell<kMiddle, kUvSide>(u_, b, g, r);
  }
  std::int16_t v(std::int16_t b, std::int16_t g, std::int16_t r) const {
    return cell<kMiddle, kUvSide>(v_, b, g, r);
  }
  std::int16_t luma(std::int16_t b, std::int16_t g, std::int16_t r) const {
    return cell<kTruncated, kLumas>(luma_, b, g, r);
  }
  ColorCell operator()(const cv::Vec3b& bgr) const {
    const std::int16_t b = scaled(bgr[0]), g = scaled(bgr[1]), r = scaled(bgr[2]);
    return {u(b, g, r), v(b, g, r), luma(b, g, r)};
  }

 private:
  using Coefficients = std::array<std::int16_t, 3>;  // of B, G, R, in 2^-15 cells

  static constexpr int kOne = 64;       // a cell
  static constexpr int kTruncated = 3;  // the most that three products lose
  static constexpr int kMiddle = (kUvSide + 1) * kOne / 2 + kTruncated;  // of the middle cell

  static Coefficients fixed(const cv::Vec3d& cells, const cv::Vec3f& gain) {
    Coefficients c;
    for (int i = 0; i < 3; ++i) {
      const double one = std::round(32768 * cells[i] * static_cast<double>(gain[i]));
      c[i] = static_cast<std::int16_t>(std::clamp(one, -32767.0, 32767.0));
    }
    return c;
  }
  static std::int16_t product(std::int16_t level, std::int16_t coefficient) {
    return static_cast<std::int16_t>((level * coefficient) >> 16);
  }
  template <int kOffset, int kCells>
  static std::int16_t cell(const Coefficients& c, std::int16_t b, std::int16_t g, std::int16_t r) {
    const auto sum =
        static_cast<std::int16_t>(product(b, c[0]) + product(g, c[1]) + product(r, c[2]) + kOffset);
    const auto at = static_cast<std::int16_t>(sum >> 6);
    const std::int16_t least = at < 0 ? std::int16_t{0} : at;
    return least >= kCells ? static_cast<std::int16_t>(kCells - 1) : least;
  }

  Coefficients u_, v_, luma_;
};

}  // namespace armsreach::gesture
