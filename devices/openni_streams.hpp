// What live OpenNI2 sensors and recordings have in common: starting the library, what a stream's
// camera is, and its images as ours.
#pragma once

#include <OpenNI.h>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/frame.hpp"
#include "vision/core/result.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

// Loads the drivers; they go with the last of the pointers. No other object of the library may
// outlive it.
class OpenNiLibrary {
 public:
  static Result<std::shared_ptr<OpenNiLibrary>> start();
  ~OpenNiLibrary();
  OpenNiLibrary(const OpenNiLibrary&) = delete;
  OpenNiLibrary& operator=(const OpenNiLibrary&) = delete;

 private:
  OpenNiLibrary() = default;
};

// What the library last complained about, or `otherwise`.
std::string openni_complaint(const std::string& otherwise);

// A pinhole camera with the stream's field of view; nothing where the driver does not know it.
std::optional<Camera> stream_camera(const openni::VideoStream& stream);

struct StreamsSensor {
  SensorInfo sensor;
  bool nominal = false;  // a field of view was not known
};
// `color` may be invalid. Registered: depth is in the colour camera's pixels.
StreamsSensor sensor_of_streams(const openni::VideoStream& depth, const openni::VideoStream& color,
                                bool registered);

// CV_32F metres, NaN unknown; CV_8UC3 BGR or CV_8UC1. Not shared with the library. Images of a
// mirrored stream are turned back.
Result<cv::Mat> depth_image(const openni::VideoFrameRef& frame, bool mirrored);
Result<cv::Mat> color_image(const openni::VideoFrameRef& frame, bool mirrored);
Timestamp frame_time(const openni::VideoFrameRef& frame);  // of the device's clock

}  // namespace armsreach
