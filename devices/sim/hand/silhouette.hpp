// The outline of a hand as a camera sees it, for banks of templates.
#pragma once

#include <opencv2/core/mat.hpp>

#include "devices/sim/hand/hand_surface.hpp"
#include "devices/sim/hand/raster.hpp"

namespace armsreach::sim {

// Where it is seen from. At zero angles the palm faces the camera and the fingers point up.
struct HandView {
  double turn = 0;        // rad about the fingers' direction, then
  double tilt = 0;        // about the image's x axis, then
  double roll = 0;        // in the image, clockwise
  double distance = 0.6;  // m from the camera to the middle of the palm
  bool left = false;      // a left hand
};
Pose camera_from_hand(const HandView& view, const HandAnatomy& anatomy);

class SilhouetteCamera {
 public:
  // Images of side x side px; a hand 0.6 m away is about 0.8 of that high.
  explicit SilhouetteCamera(int side);
  // CV_8U: 255 on the hand, 0 elsewhere.
  cv::Mat draw(const HandSurface& surface, const HandPose& pose, const HandView& view);

 private:
  Raster raster_;
  PosedSurface posed_;
};

}  // namespace armsreach::sim
