// The inner loops of Level, over planes whose rows are `stride` floats apart, a multiple of 16.
// Implementation detail.
#pragma once

#include "vision/core/isa.hpp"

namespace armsreach {

struct LevelKernels {
  // Depth to inverse depth in place, NaN where it is not positive. `size` is a multiple of 16.
  void (*invert)(float* plane, int size);
  // Central differences per pixel, NaN at the border and where either is larger than greatest_step
  // times the value, or a second difference than greatest_bend times and than bend_of_noise. There
  // must be a row above and below.
  void (*differentiate)(const float* plane, int width, int height, int stride, float greatest_step,
                        float greatest_bend, float bend_of_noise, float* along_x, float* along_y);
  // Means of 2x2 blocks, of the samples not below nearness times the largest; at least `known` of
  // them, else NaN. Reads up to 32 floats beyond the finer plane.
  void (*halve)(const float* finer, int finer_stride, float nearness, int known, float* plane,
                int width, int height, int stride);
};

LevelKernels level_kernels(Isa isa);

namespace baseline {
extern const LevelKernels kLevelKernels;
}
namespace v3 {
extern const LevelKernels kLevelKernels;
}
namespace v4 {
extern const LevelKernels kLevelKernels;
}

}  // namespace armsreach
