#include "vision/mono_slam/search_kernels.hpp"

#include "vision/core/lanes.hpp"

namespace armsreach::ARMSREACH_ISA {
namespace {

using lanes::Float;
using lanes::kWidth;

constexpr int kPlaces = mono_slam::kPlacesAbreast;
constexpr int kVectors = kPlaces / kWidth;
constexpr int kColumns = 2 * kPlaces;  // places and the windows to their right

// Adds (sign 1) or takes away (sign -1) a line of the image from its columns' sums.
ARMSREACH_INLINE void add_line(const float* line, float sign, float* sums, float* squares) {
  for (int c = 0; c < kColumns; c += kWidth) {
    const Float v = lanes::load(line + c);
    lanes::store(sums + c, lanes::load(sums + c) + sign * v);
    lanes::store(squares + c, lanes::load(squares + c) + sign * (v * v));
  }
}

ARMSREACH_INLINE void sum_windows(const float* columns, int size, float* out) {
  for (int part = 0; part < kVectors; ++part) {
    Float sum{};
    for (int c = 0; c < size; ++c) sum += lanes::load(columns + part * kWidth + c);
    lanes::store(out + part * kWidth, sum);
  }
}

ARMSREACH_INLINE void multiply(const float* image, int stride, const float* pattern, int size,
                               float* out) {
  Float sum[kVectors] = {};
  for (int y = 0; y < size; ++y) {
    const float* const line = image + y * stride;
    for (int x = 0; x < size; ++x) {
      const Float factor = lanes::all(pattern[y * size + x]);
      for (int part = 0; part < kVectors; ++part) {
        sum[part] += factor * lanes::load(line + x + part * kWidth);
      }
    }
  }
  for (int part = 0; part < kVectors; ++part) lanes::store(out + part * kWidth, sum[part]);
}

void correlate(const float* image, int stride, const float* pattern, int size, int rows,
               float* sums, float* squares, float* products) {
  float column_sums[kColumns] = {};
  float column_squares[kColumns] = {};
  for (int y = 0; y + 1 < size; ++y) {
    add_line(image + y * stride, 1.0F, column_sums, column_squares);
  }
  for (int row = 0; row < rows; ++row) {
    const float* const window = image + row * stride;
    add_line(window + (size - 1) * stride, 1.0F, column_sums, column_squares);
    sum_windows(column_sums, size, sums + row * kPlaces);
    sum_windows(column_squares, size, squares + row * kPlaces);
    multiply(window, stride, pattern, size, products + row * kPlaces);
    add_line(window, -1.0F, column_sums, column_squares);
  }
}

}  // namespace

const mono_slam::SearchKernels kSearchKernels{correlate};

}  // namespace armsreach::ARMSREACH_ISA
