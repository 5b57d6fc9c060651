// What one sensor delivers at one instant, and what is known of the sensor.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

// A sensor may have a colour camera, a depth camera or both. Poses are the depth camera's where
// there is one, else the colour camera's ("camera" alone means that one).
struct SensorInfo {
  std::string name = "main";
  std::optional<Camera> color_camera;
  std::optional<Camera> depth_camera;
  Pose color_from_depth;   // identity where the driver registers the two
  bool registered = true;  // false: colour and depth pixels do not coincide
  // False where nobody has said how the two relate and `registered` is taken for granted.
  bool registration_stated = true;
  double rate = 30;  // Hz, nominal

  const Camera& camera() const { return depth_camera ? *depth_camera : *color_camera; }
};
using SensorInfoPtr = std::shared_ptr<const SensorInfo>;

struct Truth;  // devices/truth.hpp

// Images are shared, never written after the frame has been published.
struct Frame {
  std::int64_t index = 0;
  Timestamp time = 0;
  cv::Mat color;  // CV_8UC3 BGR, or CV_8UC1 from a grey camera, or empty
  cv::Mat depth;  // CV_32F metres along z, NaN unknown; or empty
  SensorInfoPtr sensor;
  std::optional<Pose> world_from_camera;  // truth, where the source knows it; never used to track
  std::shared_ptr<const Truth> truth;     // all the rest of it, of simulated sensors; or null
  std::int64_t arrival = 0;               // steady-clock ns when it was read; for latencies only
};
using FramePtr = std::shared_ptr<const Frame>;

}  // namespace armsreach
