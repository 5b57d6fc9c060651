// A camera's intrinsics from views of a chessboard. Source: Zhang, A flexible new technique for
// camera calibration, PAMI 2000, as OpenCV has it.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "vision/calibration/chessboard.hpp"
#include "vision/core/camera.hpp"
#include "vision/core/result.hpp"

namespace armsreach::calibration {

struct CameraCalibration {
  Camera camera;
  double rms = 0;                // px, of all corners of the views that were kept
  double focal_deviation = 0;    // px, one standard deviation of fx; 0 where it is not estimated
  std::vector<double> view_rms;  // px, of each view given
  std::vector<bool> kept;        // false: left out, since its corners do not fit the others'
  std::vector<Corners> reprojected;  // where the model puts each view's corners
};

// Views of images of one size. `model` is plumb_bob, rational_polynomial or fisheye. At least three
// views are needed; a view whose error is far beyond the others' is left out. `where` names the
// images in errors.
Result<CameraCalibration> calibrate_camera(const std::vector<Corners>& views, cv::Size image,
                                           const Chessboard& board, Distortion model,
                                           const std::string& where);

}  // namespace armsreach::calibration
