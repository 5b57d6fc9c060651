// A live colour camera behind a driver. The driver is an interface of its own so that stopping,
// stalling and unplugging can be tested without hardware.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include <opencv2/core/mat.hpp>

#include "devices/source.hpp"
#include "vision/core/frame.hpp"

namespace armsreach {

class CameraDriver {
 public:
  enum class State { waiting, ready, gone };

  virtual ~CameraDriver() = default;
  // Returns as soon as an image is ready or the device has gone, at the latest after `limit`.
  virtual State wait(std::chrono::milliseconds limit) = 0;
  // The image that is ready; empty on failure. Not shared with later images.
  virtual cv::Mat read() = 0;
};

// Frames are timed by the machine's monotonic clock when they become ready, so that all live
// sensors of a rig share one clock. `place` names the device in errors.
std::unique_ptr<Source> live_camera(std::unique_ptr<CameraDriver> driver, const std::string& place,
                                    SensorInfo sensor, Events events);

}  // namespace armsreach
