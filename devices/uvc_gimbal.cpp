#include "devices/uvc_gimbal.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <numbers>
#include <stop_token>
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>

namespace armsreach {
namespace {

constexpr double kUnitsPerRadian = 3600 * 180 / std::numbers::pi;  // controls are in arc seconds
constexpr std::uint32_t kControls[] = {V4L2_CID_PAN_ABSOLUTE, V4L2_CID_TILT_ABSOLUTE};

struct Range {
  int least = 0;
  int most = 0;
  int step = 1;
};

class UvcDriver final : public GimbalDriver {
 public:
  UvcDriver(std::string device, OpenDevice open)
      : device_(std::move(device)), open_(std::move(open)) {}

  Status connect(const std::stop_token&) override {
    control_ = open_(device_);
    if (!control_) return failed("cannot be opened");
    for (std::size_t axis = 0; axis < 2; ++axis) {
      v4l2_queryctrl query{};
      query.id = kControls[axis];
      if (control_(VIDIOC_QUERYCTRL, &query) != 0 || (query.flags & V4L2_CTRL_FLAG_DISABLED)) {
        return Error{"the camera has no motors for pan and tilt", device_,
                     "v4l2-ctl -d " + device_ + " --list-ctrls shows what it has",
                     Error::Kind::device};
      }
      ranges_[axis] = {query.minimum, query.maximum, std::max(query.step, 1)};
    }
    return ok();
  }

  Status move(const Eigen::Vector3d& angles) override {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      v4l2_control control{};
      control.id = kControls[axis];
      control.value = units(ranges_[axis], angles[static_cast<Eigen::Index>(axis)]);
      // A camera that is still moving may refuse; the next command will be newer anyway.
      if (control_ && control_(VIDIOC_S_CTRL, &control) != 0 && errno != EBUSY)
        return failed("takes no commands");
    }
    return ok();
  }

  Status check() override {
    v4l2_queryctrl query{};
    query.id = kControls[0];
    return control_ && control_(VIDIOC_QUERYCTRL, &query) == 0 ? ok() : failed("has gone");
  }

  // Narrowed to what the motors do.
  GimbalModel within_ranges(GimbalModel model) const {
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      const Range& range = ranges_[axis];
      model.lower[axis] = std::max(model.lower[axis], std::min(0, range.least) / kUnitsPerRadian);
      model.upper[axis] = std::min(model.upper[axis], std::max(0, range.most) / kUnitsPerRadian);
    }
    model.lower[2] = model.upper[2] = 0;
    return model;
  }

 private:
  // The nearest step within the range.
  static int units(const Range& range, double angle) {
    const double steps = std::round((angle * kUnitsPerRadian - range.least) / range.step);
    const double value = range.least + range.step * steps;
    return static_cast<int>(std::clamp<double>(value, range.least, range.most));
  }

  Error failed(const std::string& what) const {
    const bool refused = errno == EACCES || errno == EPERM;
    return {"the pan/tilt camera " + what + ": " + std::strerror(errno), device_,
            refused ? "sudo usermod -aG video $USER, then log in again"
                    : "check its cable; it is waited for",
            Error::Kind::away};
  }

  std::string device_;
  OpenDevice open_;
  DeviceControl control_;
  Range ranges_[2];
};

}  // namespace

DeviceControl open_device_file(const std::string& path) {
  const int handle = open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0) return nullptr;
  const std::shared_ptr<const int> owned(new int(handle), [](const int* held) {
    close(*held);
    delete held;
  });
  return
      [owned](unsigned long request, void* argument) { return ioctl(*owned, request, argument); };
}

Result<std::shared_ptr<Gimbal>> open_uvc_gimbal(const UvcMotors& motors, const std::string& name,
                                                const GimbalModel& model, const OpenDevice& open) {
  auto driver = std::make_unique<UvcDriver>(motors.device, open);
  if (auto status = driver->connect({}); !status) {
    Error error = status.error();
    error.kind = Error::Kind::device;
    return error;
  }
  const GimbalModel narrowed = driver->within_ranges(model);
  return live_gimbal(std::move(driver), name, narrowed);
}

}  // namespace armsreach
