// Skin that is too far away to be the wearer's own, where depth is known.
#pragma once

#include <opencv2/core/mat.hpp>

namespace armsreach::gesture {

// `skin` (CV_8UC1, not 0 on skin) without what is farther than `reach` [m]: wood and walls have
// skin's colour. `depth` (CV_32F, m along z, NaN unknown) is of the same camera and of any size.
// What has no depth may be too near to have one; beside something far it is that one's edge.
cv::Mat within_reach(const cv::Mat& skin, const cv::Mat& depth, double reach);

}  // namespace armsreach::gesture
