// The light that a picture seems to have been taken in.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "devices/sim/hand/skin_look.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

// Grey-world: what a room's surfaces send back is on average a grey of 30 %, so the picture's mean
// is its light. A broad key comes from above the camera's left shoulder. Follows over some frames.
class PictureLight {
 public:
  void look_at(const cv::Mat& picture);  // CV_8UC3 or CV_8UC1
  Lighting lighting(const Pose& world_from_camera) const;

 private:
  Color light_{1, 1, 1};  // irradiance of a white surface that it shows as white, red first
  bool seen_ = false;
};

}  // namespace armsreach::sim
