#include "vision/gesture/color_table.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace armsreach::gesture {
namespace {

constexpr int kLevels = 1 << ColorTable::kBits;
constexpr int kStep = 256 / kLevels;

// Calls entry(index, likelihoods) for each cell's middle colour: background's likelihood first,
// then the classes'.
template <class Entry>
void for_colors(const ColorModel& model, Entry entry) {
  std::vector<ColorLikelihood> classes{ColorLikelihood(model.background)};
  for (const ColorClass& one : model.classes) classes.emplace_back(one.pixels);
  std::vector<double> likelihoods(classes.size());
  const auto balanced = [&](int level, int channel) {
    const float middle = static_cast<float>(level * kStep) + (kStep - 1) / 2.0F;
    return std::min(255, static_cast<int>(std::lround(middle * model.balance[channel])));
  };
  for (int i = 0; i < kLevels * kLevels * kLevels; ++i) {
    const Yuv color = yuv_from_bgr(balanced(i % kLevels, 0), balanced(i / kLevels % kLevels, 1),
                                   balanced(i / kLevels / kLevels, 2));
    for (std::size_t c = 0; c < classes.size(); ++c) {
      likelihoods[c] = classes[c](color, model.with_luma);
    }
    entry(i, likelihoods);
  }
}

}  // namespace

ColorTable ColorTable::winners(const ColorModel& model) {
  CV_Assert(model.classes.size() < 256);
  ColorTable table;
  for_colors(model, [&](int i, const std::vector<double>& likelihoods) {
    // The first of equals wins, so that background keeps what nobody has seen.
    const auto best = std::max_element(likelihoods.begin(), likelihoods.end());
    table.entries_[i] = static_cast<std::uint8_t>(best - likelihoods.begin());
  });
  return table;
}

ColorTable ColorTable::posteriors(const ColorModel& model, int class_index) {
  ColorTable table;
  for_colors(model, [&](int i, const std::vector<double>& likelihoods) {
    double sum = 0;
    for (const double likelihood : likelihoods) sum += likelihood;
    table.entries_[i] =
        static_cast<std::uint8_t>(std::lround(255 * likelihoods[class_index + 1] / sum));
  });
  return table;
}

void ColorTable::apply(const cv::Mat& bgr, cv::Mat* values) const {
  CV_Assert(bgr.type() == CV_8UC3);
  values->create(bgr.size(), CV_8UC1);
  for (int row = 0; row < bgr.rows; ++row) {
    const std::uint8_t* pixel = bgr.ptr(row);
    std::uint8_t* value = values->ptr(row);
    for (int col = 0; col < bgr.cols; ++col, pixel += 3) {
      value[col] = entries_[index(pixel[0], pixel[1], pixel[2])];
    }
  }
}

}  // namespace armsreach::gesture
