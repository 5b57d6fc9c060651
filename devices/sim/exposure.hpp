// Motion blur: the light of several moments of one exposure, added up.
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

// How far the picture of what stands still moves from one pose of the camera to another: the
// largest distance in px of all pixels of known depth (on a grid; `depth` in m as seen from
// `first`, NaN unknown).
double picture_motion(const cv::Mat& depth, const Camera& camera, const Pose& second_from_first);

// Moments of an exposure of `duration` s around 0 at which to draw, so that the picture moves by
// no more than about a pixel from one to the next: evenly spread, in pairs around 0 and 0 itself.
std::vector<double> exposure_moments(double duration, double motion);

// The mean light of pictures whose values are square roots of light (CV_8UC3).
class LightSum {
 public:
  void add(const cv::Mat& picture);
  int count() const { return count_; }
  cv::Mat mean() const;

 private:
  cv::Mat sum_;  // CV_32SC3, squares
  int count_ = 0;
};

}  // namespace armsreach::sim
