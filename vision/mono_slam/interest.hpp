// Where new points are worth having: corners (Shi, Tomasi, CVPR 1994) where there are none yet.
#pragma once

#include <optional>
#include <random>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace armsreach::mono_slam {

struct InterestOptions {
  int box_width = 80;  // px, of the piece of the image that is looked at
  int box_height = 60;
  int border = 12;      // from the image's edge, px
  double spacing = 14;  // from other points, px
  // The smaller eigenvalue of the mean gradient's square, (grey levels / px)^2.
  double least_strength = 12;
};

// The strongest corner of a box placed by chance, but over as few of the taken pixels as can be.
// Nothing when it holds none that is strong and far enough from those. `allowed` (CV_8UC1, 0: not
// here) may be empty.
std::optional<Eigen::Vector2d> interesting_pixel(const cv::Mat& grey, const cv::Mat& allowed,
                                                 const std::vector<Eigen::Vector2d>& taken,
                                                 const InterestOptions& options,
                                                 std::mt19937_64* random);

}  // namespace armsreach::mono_slam
