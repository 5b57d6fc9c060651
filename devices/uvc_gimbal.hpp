// The motors of a pan/tilt camera that follows the USB video class, through V4L2 controls.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "devices/live_gimbal.hpp"
#include "vision/core/gimbal.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

// ioctl(2) on an opened device: -1 and errno on failure. An interface so that it can be tested
// without hardware.
using DeviceControl = std::function<int(unsigned long request, void* argument)>;
// Opens a device file; empty, and errno, where that fails. Closed with the last copy.
using OpenDevice = std::function<DeviceControl(const std::string& path)>;
DeviceControl open_device_file(const std::string& path);

struct UvcMotors {
  std::string device = "/dev/video0";
};

// The camera's own range narrows the limits of `model`; it has no roll.
Result<std::shared_ptr<Gimbal>> open_uvc_gimbal(const UvcMotors& motors, const std::string& name,
                                                const GimbalModel& model,
                                                const OpenDevice& open = open_device_file);

}  // namespace armsreach
