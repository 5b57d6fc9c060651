// Depth seen from another camera, for occlusion and for images that are not registered.
#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach {

// `depth` (CV_32F metres along z, NaN unknown) as `target` would see it; both cameras belong to
// images of the given sizes. Each sample covers the pixels that lie within half a sample, or half a
// pixel, of it; the nearest wins; NaN where nothing falls.
cv::Mat registered_depth(const cv::Mat& depth, const Camera& camera, const Camera& target,
                         const Pose& target_from_camera);

}  // namespace armsreach
