#include "vision/alignment/level_kernels.hpp"

#include "vision/core/lanes.hpp"

namespace armsreach::ARMSREACH_ISA {
namespace {

using lanes::Float;
using lanes::kWidth;

ARMSREACH_INLINE Float unknown() { return lanes::all(__builtin_nanf("")); }

void invert(float* plane, int size) {
  for (int at = 0; at < size; at += kWidth) {
    const Float depth = lanes::load(plane + at);
    const auto known = depth > 0.0F;
    lanes::store(plane + at, known ? 1.0F / depth : unknown());
  }
}

void differentiate(const float* plane, int width, int height, int stride, float greatest_step,
                   float greatest_bend, float bend_of_noise, float* along_x, float* along_y) {
  const int last_row = (height - 1) * stride;
  for (int at = 0; at < stride; at += kWidth) {
    lanes::store(along_x + at, unknown());
    lanes::store(along_y + at, unknown());
    lanes::store(along_x + last_row + at, unknown());
    lanes::store(along_y + last_row + at, unknown());
  }
  for (int start = stride; start < last_row; start += stride) {
    for (int at = start; at < start + stride; at += kWidth) {
      const Float here = lanes::load(plane + at);
      const Float right = lanes::load(plane + at + 1) - here;
      const Float left = here - lanes::load(plane + at - 1);
      const Float below = lanes::load(plane + at + stride) - here;
      const Float above = here - lanes::load(plane + at - stride);
      const Float dx = 0.5F * (left + right);
      const Float dy = 0.5F * (above + below);
      const Float bend = lanes::max(lanes::abs(right - left), lanes::abs(below - above));
      const Float steepest = lanes::max(lanes::abs(dx), lanes::abs(dy));
      const Float straight = lanes::max(greatest_bend * here, lanes::all(bend_of_noise));
      const Float excess = lanes::max(steepest - greatest_step * here, bend - straight);
      lanes::store(along_x + at, excess <= 0.0F ? dx + 0.0F * dy : unknown());
      lanes::store(along_y + at, excess <= 0.0F ? dy + 0.0F * dx : unknown());
    }
    // Here one neighbour was in another row.
    along_x[start] = along_y[start] = __builtin_nanf("");
    along_x[start + width - 1] = along_y[start + width - 1] = __builtin_nanf("");
  }
}

// max(), with NaN only where both are.
ARMSREACH_INLINE Float largest_known(Float a, Float b) { return a >= b ? a : (b == b ? b : a); }

void halve(const float* finer, int finer_stride, float nearness, int known, float* plane, int width,
           int height, int stride) {
  for (int row = 0; row < height; ++row) {
    const float* upper = finer + 2 * row * finer_stride;
    const float* lower = upper + finer_stride;
    float* line = plane + row * stride;
    for (int col = 0; col < stride; col += kWidth) {
      const Float upper_a = lanes::load(upper + 2 * col);
      const Float upper_b = lanes::load(upper + 2 * col + kWidth);
      const Float lower_a = lanes::load(lower + 2 * col);
      const Float lower_b = lanes::load(lower + 2 * col + kWidth);
      const Float samples[4] = {lanes::even(upper_a, upper_b), lanes::odd(upper_a, upper_b),
                                lanes::even(lower_a, lower_b), lanes::odd(lower_a, lower_b)};
      const Float least = nearness * largest_known(largest_known(samples[0], samples[1]),
                                                   largest_known(samples[2], samples[3]));
      Float sum{};
      Float count{};
      for (const Float& sample : samples) {
        sum = sample >= least ? sum + sample : sum;
        count = sample >= least ? count + 1.0F : count;
      }
      lanes::store(line + col, count >= static_cast<float>(known) ? sum / count : unknown());
    }
    for (int col = width; col < stride; ++col) line[col] = __builtin_nanf("");
  }
}

}  // namespace

extern const LevelKernels kLevelKernels;
const LevelKernels kLevelKernels{invert, differentiate, halve};

}  // namespace armsreach::ARMSREACH_ISA
