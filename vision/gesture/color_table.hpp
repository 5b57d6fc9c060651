// A colour model compiled: one byte for every colour, five bits a channel, so that a pixel costs
// one load from a table that fits in the first-level cache, whatever the model is made of.
#pragma once

#include <array>
#include <cstdint>

#include <opencv2/core/mat.hpp>

#include "vision/gesture/color_model.hpp"

namespace armsreach::gesture {

class ColorTable {
 public:
  static constexpr int kBits = 5;

  // 0 for background, i + 1 for the model's class i.
  static ColorTable winners(const ColorModel& model);
  // 255 p(class|colour).
  static ColorTable posteriors(const ColorModel& model, int class_index);

  std::uint8_t at(int b, int g, int r) const { return entries_[index(b, g, r)]; }
  // CV_8UC3 BGR to CV_8UC1 of the same size.
  void apply(const cv::Mat& bgr, cv::Mat* values) const;

 private:
  static constexpr int index(int b, int g, int r) {
    return (b >> (8 - kBits)) | (g >> (8 - kBits)) << kBits | (r >> (8 - kBits)) << (2 * kBits);
  }

  std::array<std::uint8_t, 1 << (3 * kBits)> entries_{};
};

}  // namespace armsreach::gesture
