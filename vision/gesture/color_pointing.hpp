// Taught by pointing: which pixels of an image are the thing, without a mask.
#pragma once

#include <optional>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

namespace armsreach::gesture {

// CV_8UC1, 255 on the thing: the largest blob inside `region` (or anywhere but at the border) whose
// colours stand out from those around it: outside the region, or along the image's border. All 0
// where nothing stands out.
// `bgr` is CV_8UC3.
cv::Mat pointed_out(const cv::Mat& bgr, const std::optional<cv::Rect>& region);

// The part of a mask whose colours stand out from what is around it: without the rim of background
// that masks by hand or by subtraction have. CV_8UC1, not 0 inside, both.
cv::Mat own_colors(const cv::Mat& bgr, const cv::Mat& mask);

}  // namespace armsreach::gesture
