// A sensor's frames as small pinhole image pairs: what tracking and mapping work on.
#pragma once

#include <memory>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/frame.hpp"
#include "vision/core/pyramid.hpp"

namespace armsreach {

struct ReducedFrame {
  cv::Mat depth;      // CV_32F metres, NaN unknown; empty when the frame has none
  cv::Mat intensity;  // CV_32F 0..1, NaN unknown, in the depth camera's pixels; may be empty
};

class FrameReducer {
 public:
  // Reduced by the integer that brings the sensor's width nearest to `width`.
  FrameReducer(std::shared_ptr<const SensorInfo> sensor, int width);

  // Of the reduced images: pinhole, at the pose of SensorInfo::camera().
  const Camera& camera() const { return camera_; }

  // Lens distortion is taken out; colour that is not registered is looked up through its own camera
  // at the depth of each pixel. Images of another size than the sensor's cameras are ignored.
  // `depth_noise` as in reduced_depth.
  ReducedFrame reduce(const Frame& frame, double depth_noise = kKinectDepthNoise) const;

 private:
  // Pixel of a distorted reduced image for each pixel of the pinhole; empty without distortion.
  struct Reduction {
    int factor = 1;
    Camera camera;
    cv::Mat map_x, map_y;
  };
  static Reduction reduction(const Camera& camera, int width);
  cv::Mat registered(const cv::Mat& intensity, const cv::Mat& depth) const;

  std::shared_ptr<const SensorInfo> sensor_;
  Reduction depth_;
  Reduction color_;
  Camera camera_;
};

}  // namespace armsreach
