// Hands before a wall of their own colour.
//
// Wood and beige walls are skin to any model of skin; within one image they still differ from the
// hand before them. Where a blob of skin is no hand by its shape, the colours in it are parted into
// a few, and those that lie along the image's border like a wall are taken away.
#pragma once

#include <opencv2/core/mat.hpp>

namespace armsreach::gesture {

// `bgr`: CV_8UC3, `skin`: CV_8UC1 of its size, 0 off the skin. CV_8UC1 of that size, 255 on what
// remains. Costs about as much as segmenting the image twice.
cv::Mat without_walls(const cv::Mat& bgr, const cv::Mat& skin);

}  // namespace armsreach::gesture
