// Reduced images for tracking and mapping. Both reductions take an integer factor in each
// direction; a remainder at the right and lower edges is cut off.
#pragma once

#include <opencv2/core/mat.hpp>

namespace armsreach {

// k [1/m] of a sensor whose depth samples deviate by k z^2.
inline constexpr double kKinectDepthNoise = 1.425e-3;

// Depth [m, CV_32F, NaN unknown]: the mean of those samples of a block that lie behind the block's
// nearest one by at most 4 % and what noise of constant `noise` scatters (6 deviations), so that an
// edge keeps the near surface instead of an average in mid-air, and noise its mean instead of its
// nearest values. NaN where fewer than a quarter of the samples are known.
cv::Mat reduced_depth(const cv::Mat& depth, int factor, double noise = kKinectDepthNoise);

// Colour or grey 8-bit image to grey 0..1 (CV_32F), block means.
cv::Mat reduced_intensity(const cv::Mat& image, int factor);

}  // namespace armsreach
