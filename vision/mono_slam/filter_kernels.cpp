#include "vision/mono_slam/filter_kernels.hpp"

#include "vision/core/lanes.hpp"

namespace armsreach::ARMSREACH_ISA {
namespace {

constexpr int kDoubles = lanes::kWidth / 2;
using Double [[gnu::vector_size(8 * kDoubles)]] = double;

ARMSREACH_INLINE Double load(const double* p) {
  Double v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
ARMSREACH_INLINE void store(double* p, Double v) { __builtin_memcpy(p, &v, sizeof v); }

constexpr int kRows = 4;
constexpr int kColumns = 2 * kDoubles;

// One tile of p, kept in registers while all of w goes by.
ARMSREACH_INLINE void tile(double* p, const double* w, int rank, int row, int column, int stride) {
  Double sum[kRows][2] = {};
  for (int k = 0; k < rank; ++k) {
    const double* const line = w + k * stride;
    const Double left = load(line + column);
    const Double right = load(line + column + kDoubles);
    for (int r = 0; r < kRows; ++r) {
      const Double factor = line[row + r] - Double{};
      sum[r][0] += factor * left;
      sum[r][1] += factor * right;
    }
  }
  for (int r = 0; r < kRows; ++r) {
    double* const at = p + (row + r) * stride + column;
    store(at, load(at) - sum[r][0]);
    store(at + kDoubles, load(at + kDoubles) - sum[r][1]);
  }
}

// By squares, so that the columns written stay in the cache.
ARMSREACH_INLINE void mirror(double* p, int n, int stride) {
  constexpr int kSquare = 8;
  for (int top = 0; top < n; top += kSquare) {
    const int bottom = top + kSquare < n ? top + kSquare : n;
    for (int left = 0; left <= top; left += kSquare) {
      for (int row = top; row < bottom; ++row) {
        const int end = left + kSquare < row ? left + kSquare : row;
        for (int column = left; column < end; ++column) {
          p[column * stride + row] = p[row * stride + column];
        }
      }
    }
  }
}

void subtract_square(double* p, const double* w, int rank, int n, int stride) {
  for (int row = 0; row < n; row += kRows) {
    for (int column = 0; column < row + kRows; column += kColumns) {
      tile(p, w, rank, row, column, stride);
    }
  }
  mirror(p, n, stride);
}

}  // namespace

const mono_slam::FilterKernels kFilterKernels{subtract_square};

}  // namespace armsreach::ARMSREACH_ISA
