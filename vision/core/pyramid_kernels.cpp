#include "vision/core/pyramid_kernels.hpp"

#include "vision/core/lanes.hpp"

namespace armsreach::ARMSREACH_ISA {
namespace {

using lanes::Float;
using lanes::kWidth;

constexpr float kSameSurface = 0.04F;  // how far a slanted surface reaches behind its nearest point
constexpr float kFar = 1e30F;          // [m] stands for no sample

// Calls body(column) for vectors that cover 0..width; the last one overlaps its predecessor.
template <class Body>
ARMSREACH_INLINE void for_columns(int width, Body body) {
  for (int col = 0; col + kWidth <= width; col += kWidth) body(col);
  if (width % kWidth != 0) body(width - kWidth);
}

struct Sum {
  template <class T>
  [[gnu::always_inline]] T operator()(T a, T b) const {
    return a + b;
  }
};
struct Least {
  template <class T>
  [[gnu::always_inline]] T operator()(T a, T b) const {
    return a < b ? a : b;
  }
};

// Folds each block of `factor` of the width samples into one, in place, and returns their number:
// neighbours pairwise while the factor is even, the rest one after the other.
template <class Fold>
ARMSREACH_INLINE int fold_blocks(float* samples, int width, int factor, Fold fold) {
  for (; factor % 2 == 0; factor /= 2) {
    width /= 2;
    int i = 0;
    for (; i + kWidth <= width; i += kWidth) {
      const Float a = lanes::load(samples + 2 * i);
      const Float b = lanes::load(samples + 2 * i + kWidth);
      lanes::store(samples + i, fold(lanes::even(a, b), lanes::odd(a, b)));
    }
    for (; i < width; ++i) samples[i] = fold(samples[2 * i], samples[2 * i + 1]);
  }
  const int blocks = width / factor;
  for (int block = 0; factor > 1 && block < blocks; ++block) {
    float folded = samples[block * factor];
    for (int i = 1; i < factor; ++i) folded = fold(folded, samples[block * factor + i]);
    samples[block] = folded;
  }
  return blocks;
}

void depth_row(const float* depth, int step, int width, int factor, float scatter, float* scratch,
               float* reduced) {
  float* const limits = scratch;
  float* const sums = scratch + width;
  float* const counts = scratch + 2 * width;
  for_columns(width, [&](int col) {
    Float nearest = lanes::all(kFar);
    Float known{};
    for (int row = 0; row < factor; ++row) {
      const Float d = lanes::load(depth + row * step + col);
      known = d > 0.0F ? known + 1.0F : known;
      nearest = lanes::min(d > 0.0F ? d : nearest, nearest);
    }
    lanes::store(sums + col, nearest);
    lanes::store(counts + col, known);
  });
  const int blocks = fold_blocks(sums, width, factor, Least{});
  fold_blocks(counts, width, factor, Sum{});
  const float least_known = 0.25F * static_cast<float>(factor * factor);
  for (int block = 0; block < blocks; ++block) {
    const float nearest = sums[block];
    const float noise = scatter * nearest;
    const float reach = kSameSurface + noise;
    const bool known = counts[block] > 0 && counts[block] >= least_known;
    const float farthest = known ? nearest + reach * nearest : 0.0F;
    for (int i = 0; i < factor; ++i) limits[block * factor + i] = farthest;
  }
  for_columns(width, [&](int col) {
    const Float farthest = lanes::load(limits + col);
    Float sum{};
    Float count{};
    for (int row = 0; row < factor; ++row) {
      const Float d = lanes::load(depth + row * step + col);
      __builtin_prefetch(depth + (row + factor) * step + col);  // of the next block row
      const Float same = d <= farthest ? d : Float{};
      sum = same > 0.0F ? sum + same : sum;
      count = same > 0.0F ? count + 1.0F : count;
    }
    lanes::store(sums + col, sum);
    lanes::store(counts + col, count);
  });
  fold_blocks(sums, width, factor, Sum{});
  fold_blocks(counts, width, factor, Sum{});
  for (int block = 0; block < blocks; ++block) reduced[block] = sums[block] / counts[block];
}

void intensity_row(const std::uint8_t* image, int step, int width, int channels, int factor,
                   std::uint16_t* __restrict column_sums, float* __restrict grey, float* reduced) {
  const int values = width * channels;
  for (int i = 0; i < values; ++i) column_sums[i] = image[i];
  for (int row = 1; row < factor; ++row) {
    const std::uint8_t* __restrict line = image + row * step;
    for (int i = 0; i < values; ++i) {
      column_sums[i] = static_cast<std::uint16_t>(column_sums[i] + line[i]);
    }
  }
  if (channels == 1) {
    for (int i = 0; i < width; ++i) grey[i] = static_cast<float>(column_sums[i]);
  } else {  // ITU-R BT.601 luma of blue, green, red
    for (int i = 0; i < width; ++i) {
      grey[i] = 0.114F * static_cast<float>(column_sums[3 * i]) +
                0.587F * static_cast<float>(column_sums[3 * i + 1]) +
                0.299F * static_cast<float>(column_sums[3 * i + 2]);
    }
  }
  const int blocks = fold_blocks(grey, width, factor, Sum{});
  const float scale = 1.0F / (255.0F * static_cast<float>(factor * factor));
  for (int block = 0; block < blocks; ++block) reduced[block] = scale * grey[block];
}

}  // namespace

extern const PyramidKernels kPyramidKernels;
const PyramidKernels kPyramidKernels{depth_row, intensity_row};

}  // namespace armsreach::ARMSREACH_ISA
