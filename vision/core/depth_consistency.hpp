// How well depth images agree under given poses: a measure of a trajectory that needs no truth.
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach {

// Adds |dz| / z^2 [1/m] for every `step`-th pixel of `depth` in both directions: its point, seen
// from the other view, against the depth measured there. Differences over 10 % of the depth are
// other surfaces, not errors, and are left out.
void add_depth_differences(const cv::Mat& depth, const cv::Mat& other_depth, const Camera& camera,
                           const Pose& other_from_this, int step, std::vector<float>* differences);

// The middle value; NaN of nothing. Reorders the values.
float median(std::vector<float>* values);

}  // namespace armsreach
