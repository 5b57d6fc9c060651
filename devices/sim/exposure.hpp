// Motion blur: the light of several moments of one exposure, added up.
#pragma once

#include <functional>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "devices/sim/world_renderer.hpp"
#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

// How far the picture of what stands still moves from one pose of the camera to another: the
// largest distance in px of all pixels of known depth (on a grid; `depth` in m as seen from
// `first`, NaN unknown).
double picture_motion(const cv::Mat& depth, const Camera& camera, const Pose& second_from_first);

// Of one point, as it is in the camera's frame first and then; 0 where it is not seen both times.
double picture_motion(const Camera& camera, const Eigen::Vector3d& first,
                      const Eigen::Vector3d& second);

// Moments of an exposure of `duration` s around 0 at which to draw, so that the picture moves by
// no more than about 1.5 px from one to the next: evenly spread, in pairs around 0 and 0 itself.
std::vector<double> exposure_moments(double duration, double motion);

// The mean light of pictures whose values are square roots of light (CV_8UC3).
class LightSum {
 public:
  void add(const cv::Mat& picture);
  cv::Mat mean() const;

 private:
  cv::Mat sum_;  // CV_32SC3, squares
  int count_ = 0;
};

// `middle` with the colour of a whole exposure around it; `draw` gives what is seen at another of
// its moments.
Result<ExactImages> exposed(ExactImages middle, double duration, double motion,
                            const std::function<Result<ExactImages>(double moment)>& draw);

}  // namespace armsreach::sim
