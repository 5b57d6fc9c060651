// Robust standard deviation of residuals about zero.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace armsreach {

// 1.4826 times the median of the absolute values, which is the standard deviation of normally
// distributed residuals however wild up to half of the others are. NaNs do not count. The median is
// read from a histogram over the floats' leading bits and interpolated inside its bin (3 % wide),
// in linear time and without sorting. Only every `stride`-th residual is looked at.
class RobustScale {
 public:
  struct Estimate {
    double scale = 0;
    int count = 0;  // residuals looked at
  };
  Estimate operator()(std::span<const float> residuals, int stride);

 private:
  std::array<std::int32_t, 1024> histogram_{};
};

}  // namespace armsreach
