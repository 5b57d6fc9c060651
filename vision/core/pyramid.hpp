// Reduced images for tracking and mapping. Both reductions take an integer factor in each
// direction; a remainder at the right and lower edges is cut off.
#pragma once

#include <opencv2/core/mat.hpp>

namespace armsreach {

// Depth [m, CV_32F, NaN unknown]: the mean of those samples of a block that lie within 3 % of the
// block's nearest one, so that an edge keeps the near surface instead of an average in mid-air.
// NaN where fewer than a quarter of the samples are known.
cv::Mat reduced_depth(const cv::Mat& depth, int factor);

// Colour or grey 8-bit image to grey 0..1 (CV_32F), block means.
cv::Mat reduced_intensity(const cv::Mat& image, int factor);

}  // namespace armsreach
