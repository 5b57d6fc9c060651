// The noise constant k [1/m] of a depth camera whose samples deviate by k z^2: it belongs to the
// sensor (a close-range one has several times the Kinect's), so it is learnt from its images.
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/pyramid.hpp"

namespace armsreach {

class SensorNoise {
 public:
  // From a full-size depth image, CV_32F metres, NaN unknown. After thirty images that show enough
  // all is known, and more are not looked at.
  void learn(const cv::Mat& depth);
  double k() const { return k_; }  // the Kinect's until something was learnt

 private:
  double k_ = kKinectDepthNoise;
  int images_ = 0;
  std::vector<float> differences_;
};

}  // namespace armsreach
