#include "devices/v4l2.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <string>
#include <sys/ioctl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "devices/calibration.hpp"
#include "devices/image_file.hpp"
#include "devices/live_camera.hpp"

namespace armsreach {
namespace {

namespace fs = std::filesystem;

constexpr int kMostCameras = 64;  // of the kernel's 256 minors; udev numbers from 0

class V4l2Driver : public CameraDriver {
 public:
  // `first` was taken to start the stream: until then the device cannot be waited for.
  V4l2Driver(cv::VideoCapture capture, cv::Mat first) : first_(std::move(first)) {
    captures_.push_back(std::move(capture));
  }

  State wait(std::chrono::milliseconds limit) override {
    if (!first_.empty()) return State::ready;
    try {
      std::vector<int> ready;
      const auto nanoseconds = std::chrono::nanoseconds(limit).count();
      if (!cv::VideoCapture::waitAny(captures_, ready, nanoseconds)) return State::waiting;
      return ready.empty() ? State::waiting : State::ready;
    } catch (const cv::Exception&) {  // the kernel reports an error on the device
      return State::gone;
    }
  }

  cv::Mat read() override {
    if (!first_.empty()) return std::exchange(first_, {});
    cv::Mat image;
    if (!captures_.front().read(image)) return {};
    return image;
  }

 private:
  std::vector<cv::VideoCapture> captures_;  // one; waitAny takes a list
  cv::Mat first_;
};

// What the kernel says of a device file: its name, or why it cannot be opened.
Result<std::string> card_name(const fs::path& device) {
  const auto failed = [&](const std::string& what, const std::string& remedy) {
    return Error{what, device.string(), remedy, Error::Kind::device};
  };
  const int handle = open(device.c_str(), O_RDWR | O_NONBLOCK);
  if (handle < 0) {
    if (errno == ENOENT) {
      return failed(
          "no such camera",
          "plug it in; a container needs it passed in: docker run --device " + device.string());
    }
    if (errno == EACCES || errno == EPERM) {
      return failed("no permission", "sudo usermod -aG video $USER, then log in again");
    }
    return failed(std::strerror(errno), "sudo fuser -v " + device.string() + " shows who uses it");
  }
  v4l2_capability capability{};
  const bool known = ioctl(handle, VIDIOC_QUERYCAP, &capability) == 0;
  close(handle);
  if (!known) return failed("not a video device", "v4l2-ctl --list-devices shows those there are");
  if (!(capability.device_caps & V4L2_CAP_VIDEO_CAPTURE)) {
    return failed("delivers no images (a camera's second, metadata device)",
                  "use the camera's first device");
  }
  const auto* name = reinterpret_cast<const char*>(capability.card);
  return std::string(name, strnlen(name, sizeof(capability.card)));
}

Result<int> camera_number(const SourceSpec& spec) {
  const bool digits = !spec.place.empty() && spec.place.size() <= 2 &&
                      spec.place.find_first_not_of("0123456789") == std::string::npos;
  if (digits && std::stoi(spec.place) < kMostCameras) return std::stoi(spec.place);
  return Error{"'" + spec.place + "' is not the number of a camera", text_of(spec),
               "give camera:0 for /dev/video0; `armsreach sources` lists what is there"};
}

}  // namespace

Result<std::unique_ptr<Source>> open_v4l2_camera(const SourceSpec& spec,
                                                 const OpenOptions& options) {
  const auto number = camera_number(spec);
  if (!number) return number.error();
  const std::string device = "/dev/video" + std::to_string(*number);
  if (auto name = card_name(device); !name) return std::move(name).error();

  cv::VideoCapture capture(*number, cv::CAP_V4L2);
  if (options.camera) {  // a calibration holds for one image size
    capture.set(cv::CAP_PROP_FRAME_WIDTH, options.camera->camera.width);
    capture.set(cv::CAP_PROP_FRAME_HEIGHT, options.camera->camera.height);
  }
  cv::Mat first;  // a device that opens and stays silent is given up by OpenCV after 10 s
  if (!capture.isOpened() || !capture.read(first) || first.empty()) {
    return Error{"the camera gives no image", device,
                 "close other programs that use it: sudo fuser -v " + device, Error::Kind::device};
  }
  auto calibration = calibration_or_guess(options, {}, first.cols, first.rows, text_of(spec));
  if (!calibration) return std::move(calibration).error();
  if (auto fits = check_size(first.size(), calibration->camera, "colour", device); !fits) {
    return fits.error();
  }
  SensorInfo sensor;
  sensor.name = options.sensor;
  sensor.color_camera = calibration->camera;
  const double rate = capture.get(cv::CAP_PROP_FPS);
  if (rate > 0 && rate < 1e4) sensor.rate = rate;
  return live_camera(std::make_unique<V4l2Driver>(std::move(capture), std::move(first)), device,
                     std::move(sensor), std::move(calibration->events));
}

std::vector<Availability> probe_v4l2(const fs::path& folder) {
  std::vector<Availability> found;
  for (int number = 0; number < kMostCameras; ++number) {
    const fs::path device = folder / ("video" + std::to_string(number));
    std::error_code failure;
    if (!fs::exists(device, failure)) continue;
    const auto name = card_name(device);
    const std::string spec = "camera:" + std::to_string(number);
    found.push_back(name ? Availability{spec, true, *name, ""}
                         : Availability{spec, false, name.error().what, name.error().remedy});
  }
  if (found.empty()) {
    const auto missing = card_name(folder / "video0");
    found.push_back({"camera:0", false, "no camera: " + (folder / "video0").string() + " is absent",
                     missing ? "" : missing.error().remedy});
  }
  return found;
}

}  // namespace armsreach
