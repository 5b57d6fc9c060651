// What relocalisation takes from a frame: features and a small depth image, both in the frame of
// the camera that sees the features, which is the colour camera.
#pragma once

#include <optional>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/frame.hpp"
#include "vision/core/pose.hpp"
#include "vision/relocalisation/features.hpp"

namespace armsreach::relocalisation {

struct View {
  Features features;
  double pixel_size = 0;  // at distance one, of the image the features were found in
  Camera camera;          // of the small image, lens distortion included
  cv::Mat depth;          // CV_32F m along z, NaN unknown; empty when (almost) none is known
};

// Nothing when the frame has no colour image.
std::optional<View> view_of(const Frame& frame, int most_features);

// From the camera that poses belong to, the depth camera where there is one, to the colour camera.
Pose color_from_camera(const SensorInfo& sensor);

// Of the surface that one view sees and the other should see too.
struct DepthAgreement {
  int agreeing = 0;       // pixels at the depth the other view has there
  int contradicting = 0;  // pixels of a surface that the other view looks through
  int hidden = 0;         // pixels behind what the other view sees: no contradiction
  double share() const {
    const int judged = agreeing + contradicting;
    return judged > 0 ? static_cast<double>(agreeing) / judged : 0;
  }
};
// Both ways: a's surface in b and b's in a. All zero when one has no depth.
DepthAgreement depth_agreement(const View& a, const View& b, const Pose& b_from_a);

}  // namespace armsreach::relocalisation
