#include "vision/core/pyramid_kernels.hpp"

#include "vision/core/lanes.hpp"

namespace armsreach::ARMSREACH_ISA {
namespace {

using lanes::Float;
using lanes::kWidth;

constexpr float kSameSurface = 1.03F;  // samples up to 3 % behind the nearest are one surface
constexpr float kFar = 1e30F;          // [m] stands for no sample

// Calls body(column) for vectors that cover 0..width; the last one overlaps its predecessor.
template <class Body>
ARMSREACH_INLINE void for_columns(int width, Body body) {
  for (int col = 0; col + kWidth <= width; col += kWidth) body(col);
  if (width % kWidth != 0) body(width - kWidth);
}

ARMSREACH_INLINE float block_sum(const float* samples, int count) {
  float sum = 0;
  for (int i = 0; i < count; ++i) sum += samples[i];
  return sum;
}

ARMSREACH_INLINE float block_min(const float* samples, int count) {
  float least = kFar;
  for (int i = 0; i < count; ++i) least = samples[i] < least ? samples[i] : least;
  return least;
}

void depth_row(const float* depth, int step, int width, int factor, float* scratch,
               float* reduced) {
  float* const limit = scratch;
  float* const sum = scratch + width;
  float* const counts = scratch + 2 * width;
  for_columns(width, [&](int col) {
    Float nearest = lanes::all(kFar);
    Float known{};
    for (int row = 0; row < factor; ++row) {
      const Float d = lanes::load(depth + row * step + col);
      nearest = (d > 0.0F) & (d < nearest) ? d : nearest;
      known += d > 0.0F ? lanes::all(1.0F) : Float{};
    }
    lanes::store(limit + col, nearest);
    lanes::store(counts + col, known);
  });
  const int blocks = width / factor;
  for (int block = 0; block < blocks; ++block) {
    const float farthest = kSameSurface * block_min(limit + block * factor, factor);
    for (int i = 0; i < factor; ++i) limit[block * factor + i] = farthest;
    reduced[block] = block_sum(counts + block * factor, factor);
  }
  for_columns(width, [&](int col) {
    const Float farthest = lanes::load(limit + col);
    Float total{};
    Float count{};
    for (int row = 0; row < factor; ++row) {
      const Float d = lanes::load(depth + row * step + col);
      const auto same = (d > 0.0F) & (d <= farthest);
      total += same ? d : Float{};
      count += same ? lanes::all(1.0F) : Float{};
    }
    lanes::store(sum + col, total);
    lanes::store(counts + col, count);
  });
  const float least_known = 0.25F * static_cast<float>(factor * factor);
  for (int block = 0; block < blocks; ++block) {
    const bool known = reduced[block] > 0 && reduced[block] >= least_known;
    reduced[block] = known ? block_sum(sum + block * factor, factor) /
                                 block_sum(counts + block * factor, factor)
                           : __builtin_nanf("");
  }
}

void intensity_row(const std::uint8_t* image, int step, int width, int channels, int factor,
                   std::uint16_t* scratch, float* reduced) {
  const int values = width * channels;
  for (int i = 0; i < values; ++i) scratch[i] = image[i];
  for (int row = 1; row < factor; ++row) {
    const std::uint8_t* line = image + row * step;
    for (int i = 0; i < values; ++i) scratch[i] = static_cast<std::uint16_t>(scratch[i] + line[i]);
  }
  const float scale = 1.0F / (255.0F * static_cast<float>(factor * factor));
  for (int block = 0; block < width / factor; ++block) {
    const std::uint16_t* first = scratch + block * factor * channels;
    int sums[3] = {0, 0, 0};
    for (int i = 0; i < factor; ++i) {
      for (int c = 0; c < channels; ++c) sums[c] += first[i * channels + c];
    }
    // ITU-R BT.601 luma of blue, green, red.
    const float grey = channels == 1 ? static_cast<float>(sums[0])
                                     : 0.114F * static_cast<float>(sums[0]) +
                                           0.587F * static_cast<float>(sums[1]) +
                                           0.299F * static_cast<float>(sums[2]);
    reduced[block] = scale * grey;
  }
}

}  // namespace

extern const PyramidKernels kPyramidKernels;
const PyramidKernels kPyramidKernels{depth_row, intensity_row};

}  // namespace armsreach::ARMSREACH_ISA
