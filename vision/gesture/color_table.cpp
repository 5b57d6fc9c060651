#include "vision/gesture/color_table.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::gesture {
namespace {

// More for background than for the classes: what nobody has seen is background.
constexpr double kUnseenBackground = 0.02;
constexpr double kUnseenClass = 0.01;

}  // namespace

ColorTable::ColorTable(const ColorModel& model)
    : projection_(model.balance),
      lumas_(model.with_luma ? kLumas : 1),
      entries_(static_cast<std::size_t>(lumas_) * kUvSide * kUvSide) {
  CV_Assert(model.classes.size() < 256);
}

// Calls value(likelihoods) for each cell: background's likelihood first, then the classes'.
template <class Value>
void ColorTable::fill(const ColorModel& model, Value value) {
  std::vector<ColorLikelihood> classes{ColorLikelihood(model.background, kUnseenBackground)};
  for (const ColorClass& one : model.classes) classes.emplace_back(one.pixels, kUnseenClass);
  std::vector<float> likelihoods(classes.size());
  auto entry = entries_.begin();
  for (int luma = 0; luma < lumas_; ++luma) {
    for (int v = 0; v < kUvSide; ++v) {
      for (int u = 0; u < kUvSide; ++u) {
        for (std::size_t c = 0; c < classes.size(); ++c) {
          likelihoods[c] = classes[c].uv(v, u) * (lumas_ > 1 ? classes[c].luma[luma] : 1.0F);
        }
        *entry++ = value(likelihoods);
      }
    }
  }
}

ColorTable ColorTable::winners(const ColorModel& model) {
  ColorTable table(model);
  table.fill(model, [](const std::vector<float>& likelihoods) {
    const auto best = std::max_element(likelihoods.begin(), likelihoods.end());
    return static_cast<std::uint8_t>(best - likelihoods.begin());
  });
  return table;
}

ColorTable ColorTable::posteriors(const ColorModel& model, int class_index) {
  ColorTable table(model);
  table.fill(model, [class_index](const std::vector<float>& likelihoods) {
    float sum = 0;
    for (const float likelihood : likelihoods) sum += likelihood;
    return static_cast<std::uint8_t>(255 * likelihoods[class_index + 1] / sum + 0.5F);
  });
  return table;
}

std::uint8_t ColorTable::at(const cv::Vec3b& bgr) const {
  const ColorCell cell = projection_(bgr);
  return entries_[((lumas_ > 1 ? cell.luma : 0) * kUvSide + cell.v) * kUvSide + cell.u];
}

void ColorTable::apply(const cv::Mat& bgr, cv::Mat* values) const {
  CV_Assert(bgr.type() == CV_8UC3);
  values->create(bgr.size(), CV_8UC1);
  for (int row = 0; row < bgr.rows; ++row) {
    const auto* pixels = bgr.ptr<cv::Vec3b>(row);
    std::uint8_t* value = values->ptr(row);
    for (int col = 0; col < bgr.cols; ++col) value[col] = at(pixels[col]);
  }
}

}  // namespace armsreach::gesture
