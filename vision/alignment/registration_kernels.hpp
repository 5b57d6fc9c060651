// The inner loop of FrameReducer: an image of one camera, looked up at the pixels of another whose
// depth is known. Implementation detail.
#pragma once

#include "vision/core/isa.hpp"

namespace armsreach {

struct RegistrationRow {
  const float* depth;             // [m] of the row's pixels, NaN unknown
  int width;                      // at least 16
  float first_x, x_per_pixel, y;  // rays of the row, at depth 1
  float rotation[3][3];           // image's camera from depth camera
  float translation[3];
};

struct RegistrationImage {
  const float* pixels;  // of a pinhole; rows `step` floats apart
  int width, height, step;
  float fx, fy, cx, cy;
};

struct RegistrationKernels {
  // Bilinear, NaN where there is no depth or the image does not reach.
  void (*look_up_row)(const RegistrationRow& row, const RegistrationImage& image, float* out);
};

RegistrationKernels registration_kernels(Isa isa);

namespace baseline {
extern const RegistrationKernels kRegistrationKernels;
}
namespace v3 {
extern const RegistrationKernels kRegistrationKernels;
}
namespace v4 {
extern const RegistrationKernels kRegistrationKernels;
}

}  // namespace armsreach
