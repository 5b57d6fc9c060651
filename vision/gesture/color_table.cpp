#include "vision/gesture/color_table.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::gesture {
namespace {

// More for background than for the classes: what nobody has seen is background.
constexpr double kUnseenBackground = 0.02;
constexpr double kUnseenClass = 0.01;

// The scaled levels of a row, channel by channel. Three plain loops over a row, none of which
// the compiler has to suspect of writing what another reads, are all vectors but for the loads
// from the table.
struct Row {
  explicit Row(int width) : b(width), g(width), r(width), cells(width), lumas(width) {}

  std::vector<std::int16_t> b, g, r;
  std::vector<std::uint16_t> cells;  // v * kUvSide + u
  std::vector<std::uint8_t> lumas;
};

void split(const std::uint8_t* __restrict bgr, int width, std::int16_t* __restrict b,
           std::int16_t* __restrict g, std::int16_t* __restrict r) {
  for (int i = 0; i < width; ++i) {
    b[i] = ColorProjection::scaled(bgr[3 * i]);
    g[i] = ColorProjection::scaled(bgr[3 * i + 1]);
    r[i] = ColorProjection::scaled(bgr[3 * i + 2]);
  }
}

void find_cells(const ColorProjection projection, const std::int16_t* __restrict b,
                const std::int16_t* __restrict g, const std::int16_t* __restrict r, int width,
                std::uint16_t* __restrict cells) {
  for (int i = 0; i < width; ++i) {
    cells[i] = static_cast<std::uint16_t>(projection.v(b[i], g[i], r[i]) * kUvSide +
                                          projection.u(b[i], g[i], r[i]));
  }
}

void find_lumas(const ColorProjection projection, const std::int16_t* __restrict b,
                const std::int16_t* __restrict g, const std::int16_t* __restrict r, int width,
                std::uint8_t* __restrict lumas) {
  for (int i = 0; i < width; ++i) {
    lumas[i] = static_cast<std::uint8_t>(projection.luma(b[i], g[i], r[i]));
  }
}

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
  const int width = bgr.cols;
  Row line(width);
  for (int row = 0; row < bgr.rows; ++row) {
    std::uint8_t* __restrict value = values->ptr(row);
    const std::uint8_t* __restrict entries = entries_.data();
    split(bgr.ptr(row), width, line.b.data(), line.g.data(), line.r.data());
    find_cells(projection_, line.b.data(), line.g.data(), line.r.data(), width, line.cells.data());
    const std::uint16_t* __restrict cells = line.cells.data();
    if (lumas_ == 1) {
      for (int i = 0; i < width; ++i) value[i] = entries[cells[i]];
      continue;
    }
    find_lumas(projection_, line.b.data(), line.g.data(), line.r.data(), width, line.lumas.data());
    const std::uint8_t* __restrict lumas = line.lumas.data();
    for (int i = 0; i < width; ++i) value[i] = entries[lumas[i] * kUvSide * kUvSide + cells[i]];
  }
}

}  // namespace armsreach::gesture
