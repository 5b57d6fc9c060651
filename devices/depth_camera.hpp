// A live depth camera, with colour or without, behind a driver that delivers images from threads of
// its own. The driver is an interface so that unplugging and coming back are tested without
// hardware.
#pragma once

#include <memory>
#include <string>

#include <opencv2/core/mat.hpp>

#include "devices/open.hpp"
#include "devices/source.hpp"
#include "vision/core/event.hpp"
#include "vision/core/frame.hpp"
#include "vision/core/result.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

// What a driver tells, from any of its threads.
class DepthCameraListener {
 public:
  virtual ~DepthCameraListener() = default;
  // Images are not shared with later ones. `time` is the device's: one clock for both, any zero.
  virtual void on_color(cv::Mat color, Timestamp time) = 0;  // CV_8UC3 BGR or CV_8UC1
  virtual void on_depth(cv::Mat depth, Timestamp time) = 0;  // CV_32F metres, NaN unknown
  virtual void on_gone(const std::string& what) = 0;         // "was unplugged": no more images come
  virtual void on_arrival() = 0;                             // a device was plugged in: try open()
};

class DepthCameraDriver {
 public:
  struct Opened {
    SensorInfo sensor;
    bool nominal = false;  // the cameras are those of the model, not of this very device
    Events events;
  };

  virtual ~DepthCameraDriver() = default;
  // Starts the streams; again after close(). The listener outlives the driver.
  virtual Result<Opened> open(DepthCameraListener& listener) = 0;
  // Stops them: when it returns, on_color, on_depth and on_gone are not called any more. Never
  // called from within these.
  virtual void close() = 0;
};

struct CalibratedSensor {
  SensorInfo sensor;
  Events events;  // says so where the cameras are nominal
};
// What `options` make of the cameras that a driver knows: --camera describes the depth camera (and
// a registered colour camera with it), or, when it has camera_from_depth, the colour camera.
Result<CalibratedSensor> calibrate_depth_camera(SensorInfo sensor, bool nominal,
                                                const OpenOptions& options,
                                                const std::string& place);

// Opens the driver. Frames are timed by the machine's monotonic clock when their depth arrives, so
// that all live sensors of a rig share one clock; colour and depth are paired by the device's.
// When the device goes, next() says so once with Error::Kind::away and then waits for it to come
// back. `place` names the device in errors, `options.camera` takes the place of the driver's
// cameras.
Result<std::unique_ptr<Source>> open_depth_camera(std::unique_ptr<DepthCameraDriver> driver,
                                                  const std::string& place,
                                                  const OpenOptions& options);

}  // namespace armsreach
