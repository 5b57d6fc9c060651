// The inner loop of the filter's update. Implementation detail.
#pragma once

#include "vision/core/isa.hpp"

namespace armsreach::mono_slam {

struct FilterKernels {
  // p -= w^T w for the symmetric n x n matrix p and the rank x n matrix w, both by rows `stride`
  // apart; the lower triangle is computed and mirrored. stride is a multiple of 16 and >= n; what
  // lies between n and stride in p is written to. p has a multiple of 4 rows.
  void (*subtract_square)(double* p, const double* w, int rank, int n, int stride);
};

FilterKernels filter_kernels(Isa isa);

}  // namespace armsreach::mono_slam

namespace armsreach {
namespace baseline {
extern const mono_slam::FilterKernels kFilterKernels;
}
namespace v3 {
extern const mono_slam::FilterKernels kFilterKernels;
}
namespace v4 {
extern const mono_slam::FilterKernels kFilterKernels;
}
}  // namespace armsreach
