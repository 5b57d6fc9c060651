// A real gimbal behind a driver: its own thread talks to the device, newest command first and no
// faster than servos take them, finds it again after it has gone, and leaves it at rest.
//
// Times are the machine's monotonic clock, as those of all live sensors. Servos measure nothing:
// states are what the model says of the commands that were sent.
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "devices/gimbal.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

// Called by one thread at a time.
class GimbalDriver {
 public:
  virtual ~GimbalDriver() = default;
  // Finds the device and makes it ready. May take seconds, but ends soon when it shall stop.
  virtual Status connect(const std::stop_token& stop) = 0;
  // Starts towards these angles of pan, tilt and roll, which are within the limits; rad.
  virtual Status move(const Eigen::Vector3d& angles) = 0;
  // Whether it is still there.
  virtual Status check() = 0;
};

// `driver` is connected. `name` is that of the sensor that the gimbal carries.
std::shared_ptr<Gimbal> live_gimbal(std::unique_ptr<GimbalDriver> driver, const std::string& name,
                                    const GimbalModel& model);

}  // namespace armsreach
