// The shadow a hand casts on a wall of its own colour.
//
// Chrominance hardly changes in a shadow, so to a model of skin's U and V it is skin. It is far
// darker than the hand, though, and with an edge between: more than a hand's own shading is.
#pragma once

#include <opencv2/core/mat.hpp>

namespace armsreach::gesture {

// `bgr`: CV_8UC3, `skin`: CV_8UC1 of its size, 0 off the skin. CV_8UC1 of that size: the skin
// without its dark part, or all of it where brightness does not part it in two.
cv::Mat without_shadow(const cv::Mat& bgr, const cv::Mat& skin);

}  // namespace armsreach::gesture
