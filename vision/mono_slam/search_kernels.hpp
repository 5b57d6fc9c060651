// The inner loop of template search. Implementation detail.
#pragma once

#include "vision/core/isa.hpp"

namespace armsreach::mono_slam {

inline constexpr int kPlacesAbreast = 16;

struct SearchKernels {
  // For `rows` lines of 16 neighbouring places: sums, over a size x size window starting at each
  // place, of the image, of its square and of its product with the template. `image` is the first
  // place's window, lines `stride` apart, readable 16 + size - 1 samples on (and up to 16 more).
  // All values are whole numbers of 0..255 and size <= 15, so the sums are exact.
  void (*correlate)(const float* image, int stride, const float* pattern, int size, int rows,
                    float* sums, float* squares, float* products);
};

SearchKernels search_kernels(Isa isa);

}  // namespace armsreach::mono_slam

namespace armsreach {
namespace baseline {
extern const mono_slam::SearchKernels kSearchKernels;
}
namespace v3 {
extern const mono_slam::SearchKernels kSearchKernels;
}
namespace v4 {
extern const mono_slam::SearchKernels kSearchKernels;
}
}  // namespace armsreach
