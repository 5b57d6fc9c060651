// The inner loops of the aligner. Implementation detail.
#pragma once

#include "vision/core/isa.hpp"

namespace armsreach {

// A Level as the kernels see it: planes of stride x height, stride a multiple of 16.
struct Planes {
  int width, height, stride;
  float fx, fy, cx, cy;
  const float* inverse_depth;
  const float* inverse_depth_x;
  const float* inverse_depth_y;
  const float* intensity;
  const float* intensity_x;
  const float* intensity_y;
};

// target_from_source, and the target's intensity minus the source's.
struct Warp {
  float rotation[3][3];
  float translation[3];
  float intensity_offset;
};

// What a warp finds at each pixel of the source: arrays of the source's stride x height. X = x/z
// and Y = y/z locate the point in the target, g are the mean derivatives of the two images by X and
// Y. A residual that does not exist is NaN.
struct Residuals {
  float* depth;      // inverse depth of the target minus that of the warped point [1/m]
  float* intensity;  // intensity of the target minus that of the source minus the offset
  float* X;
  float* Y;
  float* inverse_z;
  float* depth_gX;
  float* depth_gY;
  float* intensity_gX;
  float* intensity_gY;
};

// Tukey's biweight w(r) = gain * (1 - (r / cutoff)^2)^2, zero from the cutoff on.
struct Weighting {
  float gain = 0;
  float cutoff = 1;
};

// The normal equations' upper triangle by rows, unknowns (translation, rotation, offset); then
// their right-hand side; then the weighted squares.
constexpr int kUnknowns = 7;
constexpr int kTriangle = kUnknowns * (kUnknowns + 1) / 2;
constexpr int kSums = kTriangle + kUnknowns + 1;

struct AlignKernels {
  void (*warp)(const Planes& source, const Planes& target, const Warp& target_from_source,
               const Residuals& out);
  // Accumulates over `size` pixels (a multiple of 16).
  void (*accumulate)(const Residuals& residuals, int size, const Weighting& depth,
                     const Weighting& intensity, double sums[kSums]);
  // Per pixel the weight in 0..1, NaN where there is no residual.
  void (*weigh)(const Residuals& residuals, int size, const Weighting& depth,
                const Weighting& intensity, float* weights);
};

AlignKernels align_kernels(Isa isa);

namespace baseline {
extern const AlignKernels kAlignKernels;
}
namespace v3 {
extern const AlignKernels kAlignKernels;
}
namespace v4 {
extern const AlignKernels kAlignKernels;
}

}  // namespace armsreach
