// The inner loops of pyramid.cpp, one block row at a time. Implementation detail.
#pragma once

#include <cstdint>

#include "vision/core/isa.hpp"

namespace armsreach {

struct PyramidKernels {
  // A block row of `factor` image rows of `width` samples, `step` floats apart, to width / factor
  // means of what lies up to 4 % of its depth and `scatter` [1/m] times the depth's square behind
  // the block's nearest.
  // `scratch` holds 3 * width floats. width >= 16.
  void (*depth_row)(const float* depth, int step, int width, int factor, float scatter,
                    float* scratch, float* reduced);
  // The same for 8-bit pixels of 1 or 3 channels, rows `step` bytes apart, to 0..1. `column_sums`
  // holds width * channels, `grey` width; factor <= 256.
  void (*intensity_row)(const std::uint8_t* image, int step, int width, int channels, int factor,
                        std::uint16_t* column_sums, float* grey, float* reduced);
};

PyramidKernels pyramid_kernels(Isa isa);

namespace baseline {
extern const PyramidKernels kPyramidKernels;
}
namespace v3 {
extern const PyramidKernels kPyramidKernels;
}
namespace v4 {
extern const PyramidKernels kPyramidKernels;
}

}  // namespace armsreach
