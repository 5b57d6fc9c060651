// Whether an image has colours at all.
#pragma once

#include <opencv2/core/mat.hpp>

namespace armsreach::gesture {

// CV_8UC3 BGR. False for other images, and for those of a grey camera that are stored in colour.
bool has_color(const cv::Mat& image);

}  // namespace armsreach::gesture
