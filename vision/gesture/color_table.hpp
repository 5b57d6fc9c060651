// A colour model compiled: one byte for every cell of colour. Without brightness the table has
// 16 KiB and stays in the first-level cache.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/gesture/color_model.hpp"

namespace armsreach::gesture {

class ColorTable {
 public:
  // 0 for background, i + 1 for the model's class i.
  static ColorTable winners(const ColorModel& model);
  // 255 p(class|colour).
  static ColorTable posteriors(const ColorModel& model, int class_index);

  std::uint8_t at(const cv::Vec3b& bgr) const;
  // CV_8UC3 BGR to CV_8UC1 of the same size.
  void apply(const cv::Mat& bgr, cv::Mat* values) const;

 private:
  explicit ColorTable(const ColorModel& model);
  template <class Value>
  void fill(const ColorModel& model, Value value);

  ColorProjection projection_;
  int lumas_;                          // kLumas, or 1 without brightness
  std::vector<std::uint8_t> entries_;  // [luma][v][u]
};

}  // namespace armsreach::gesture
