#include "devices/freenect.hpp"

#include <atomic>
#include <libfreenect.h>
#include <libfreenect_registration.h>
#include <optional>
#include <string>
#include <sys/time.h>
#include <thread>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "devices/depth_camera.hpp"
#include "devices/kinect_model.hpp"

namespace armsreach {
namespace {

constexpr int kMostKinects = 16;
constexpr double kTicksPerSecond = 60e6;      // of a Kinect's clock
constexpr suseconds_t kEventWait = 50'000;    // us, and so the longest that close() waits
constexpr int kInterrupted = -10;             // libusb: a signal ended the wait, nothing is wrong
constexpr const char* kUsbGroup = "plugdev";  // that of the distribution's udev rules

bool is_kinect(const UsbDevice& device) {
  return device.vendor == "045e" && (device.product == "02ae" || device.product == "02bf");
}

std::vector<UsbDevice> kinects_of(const std::vector<UsbDevice>& devices) {
  std::vector<UsbDevice> kinects;
  for (const UsbDevice& device : devices) {
    if (is_kinect(device)) kinects.push_back(device);
  }
  return kinects;
}

UsbObstacle absence() {
  return usb_absence("no Kinect is plugged in",
                     "plug it in, and its own power supply: without that it is not seen");
}

struct ContextCloser {
  void operator()(freenect_context* context) const { freenect_shutdown(context); }
};
struct DeviceCloser {
  void operator()(freenect_device* device) const { freenect_close_device(device); }
};
using Context = std::unique_ptr<freenect_context, ContextCloser>;
using Device = std::unique_ptr<freenect_device, DeviceCloser>;

// The device's 32-bit clock, which starts again every 72 s, as nanoseconds.
class TickClock {
 public:
  Timestamp time(std::uint32_t ticks) {
    // Colour and depth come nearly in order: the step may be a small one backwards.
    ticks_ += static_cast<std::int32_t>(ticks - static_cast<std::uint32_t>(ticks_));
    return timestamp_from_seconds(static_cast<double>(ticks_) / kTicksPerSecond);
  }

 private:
  std::int64_t ticks_ = 0;
};

enum class DepthKind { registered, unregistered, raw };

freenect_depth_format format_of(DepthKind kind) {
  switch (kind) {
    case DepthKind::registered:
      return FREENECT_DEPTH_REGISTERED;
    case DepthKind::unregistered:
      return FREENECT_DEPTH_MM;
    case DepthKind::raw:
      break;
  }
  return FREENECT_DEPTH_11BIT;
}

KinectGeometry factory_geometry(freenect_device* device) {
  freenect_registration registration = freenect_copy_registration(device);
  const freenect_zero_plane_info& stored = registration.zero_plane_info;  // in centimetres
  KinectGeometry geometry;
  if (stored.reference_distance > 0 && stored.reference_pixel_size > 0) {
    geometry.emitter_distance = 0.01 * static_cast<double>(stored.dcmos_emitter_dist);
    geometry.color_distance = 0.01 * static_cast<double>(stored.dcmos_rcmos_dist);
    geometry.reference_distance = 0.01 * static_cast<double>(stored.reference_distance);
    geometry.reference_pixel = 0.01 * static_cast<double>(stored.reference_pixel_size);
  }
  freenect_destroy_registration(&registration);
  return geometry;
}

class FreenectDriver : public DepthCameraDriver {
 public:
  FreenectDriver(int number, DepthKind kind)
      : number_(number), kind_(kind), place_("freenect:" + std::to_string(number)) {}
  ~FreenectDriver() override { close(); }

  Result<Opened> open(DepthCameraListener& listener) override;
  void close() override;

 private:
  Status open_device();
  Status start_streams();
  void pump();
  Error failure(const std::string& what) const;

  static void on_depth(freenect_device* device, void* image, std::uint32_t ticks);
  static void on_video(freenect_device* device, void* image, std::uint32_t ticks);

  const int number_;
  const DepthKind kind_;
  const std::string place_;
  DepthCameraListener* listener_ = nullptr;
  KinectGeometry geometry_;
  TickClock clock_;
  Context context_;
  Device device_;
  std::thread pump_;  // delivers all images
  std::atomic<bool> stopping_ = false;
};

Result<DepthCameraDriver::Opened> FreenectDriver::open(DepthCameraListener& listener) {
  listener_ = &listener;
  clock_ = TickClock();
  auto status = open_device();
  if (status) status = start_streams();
  if (!status) {
    close();
    return status.error();
  }
  stopping_ = false;
  pump_ = std::thread([this] { pump(); });
  Opened opened;
  opened.sensor =
      kind_ == DepthKind::registered ? registered_kinect() : unregistered_kinect(geometry_);
  opened.nominal = true;  // the colour camera always is
  return opened;
}

void FreenectDriver::close() {
  stopping_ = true;
  if (pump_.joinable()) pump_.join();
  if (device_) {
    freenect_stop_depth(device_.get());
    freenect_stop_video(device_.get());
  }
  device_.reset();
  context_.reset();
}

Status FreenectDriver::open_device() {
  freenect_context* context = nullptr;
  if (freenect_init(&context, nullptr) < 0) return failure("the USB library does not start");
  context_.reset(context);
  freenect_set_log_level(context, FREENECT_LOG_FATAL);  // what is wrong is told by our errors
  freenect_select_subdevices(context, FREENECT_DEVICE_CAMERA);
  if (freenect_num_devices(context) <= number_) return failure("there is no such Kinect");
  freenect_device* device = nullptr;
  if (freenect_open_device(context, &device, number_) < 0) return failure("cannot be opened");
  device_.reset(device);
  return ok();
}

Status FreenectDriver::start_streams() {
  freenect_device* device = device_.get();
  if (kind_ == DepthKind::unregistered) geometry_ = factory_geometry(device);
  freenect_set_user(device, this);
  freenect_set_depth_callback(device, on_depth);
  freenect_set_video_callback(device, on_video);
  const auto depth = freenect_find_depth_mode(FREENECT_RESOLUTION_MEDIUM, format_of(kind_));
  const auto color = freenect_find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB);
  if (!depth.is_valid || !color.is_valid || freenect_set_depth_mode(device, depth) < 0 ||
      freenect_set_video_mode(device, color) < 0) {
    return failure("does not know colour and depth of 640x480");
  }
  if (freenect_start_depth(device) < 0 || freenect_start_video(device) < 0) {
    return failure("does not start to stream");
  }
  return ok();
}

void FreenectDriver::pump() {
  while (!stopping_) {
    timeval wait{0, kEventWait};
    const int result = freenect_process_events_timeout(context_.get(), &wait);
    if (result >= 0 || result == kInterrupted) continue;
    listener_->on_gone("the Kinect has gone");
    return;
  }
}

void FreenectDriver::on_depth(freenect_device* device, void* image, std::uint32_t ticks) {
  auto* self = static_cast<FreenectDriver*>(freenect_get_user(device));
  self->listener_->on_depth(self->kind_ == DepthKind::raw
                                ? depth_from_numbers(image, self->geometry_)
                                : depth_from_millimetres(image),
                            self->clock_.time(ticks));
}

void FreenectDriver::on_video(freenect_device* device, void* image, std::uint32_t ticks) {
  auto* self = static_cast<FreenectDriver*>(freenect_get_user(device));
  const cv::Mat rgb(480, 640, CV_8UC3, image);
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  self->listener_->on_color(bgr, self->clock_.time(ticks));
}

// What USB says of the device is worth more than the library's "it failed".
Error FreenectDriver::failure(const std::string& what) const {
  const std::vector<UsbDevice> kinects = kinects_of(usb_devices());
  Error error{what, place_, "close other programs that use it, then plug it in again",
              Error::Kind::device};
  if (kinects.empty()) {
    const UsbObstacle none = absence();
    error.what = none.what;
    error.remedy = none.remedy;
  } else if (static_cast<std::size_t>(number_) >= kinects.size()) {
    error.remedy = "the last one is freenect:" + std::to_string(kinects.size() - 1);
  } else if (const auto obstacle =
                 usb_obstacle(kinects[static_cast<std::size_t>(number_)], kUsbGroup)) {
    error.what = what + ": " + obstacle->what;
    error.remedy = obstacle->remedy;
  }
  return error;
}

Result<int> kinect_number(const SourceSpec& spec) {
  const bool digits = !spec.place.empty() && spec.place.size() <= 2 &&
                      spec.place.find_first_not_of("0123456789") == std::string::npos;
  if (digits && std::stoi(spec.place) < kMostKinects) return std::stoi(spec.place);
  return Error{"'" + spec.place + "' is not the number of a Kinect", text_of(spec),
               "give freenect:0 for the first; `armsreach sources` lists what is there"};
}

Result<DepthKind> depth_option(const SourceSpec& spec) {
  const std::string text = option(spec, "depth").value_or("registered");
  if (text == "registered") return DepthKind::registered;
  if (text == "unregistered") return DepthKind::unregistered;
  if (text == "raw") return DepthKind::raw;
  return Error{"option 'depth' is '" + text + "'", text_of(spec),
               "give depth=registered, depth=unregistered or depth=raw"};
}

}  // namespace

Result<std::unique_ptr<Source>> open_freenect_camera(const SourceSpec& spec,
                                                     const OpenOptions& options) {
  const auto number = kinect_number(spec);
  if (!number) return number.error();
  const auto kind = depth_option(spec);
  if (!kind) return kind.error();
  return open_depth_camera(std::make_unique<FreenectDriver>(*number, *kind), text_of(spec),
                           options);
}

std::vector<Availability> probe_freenect(const std::vector<UsbDevice>& devices) {
  std::vector<Availability> found;
  for (const UsbDevice& kinect : kinects_of(devices)) {
    const std::string spec = "freenect:" + std::to_string(found.size());
    const auto obstacle = usb_obstacle(kinect, kUsbGroup);
    found.push_back(obstacle ? Availability{spec, false, obstacle->what, obstacle->remedy}
                             : Availability{spec, true, "a Kinect v1", ""});
  }
  if (found.empty()) {
    const UsbObstacle none = absence();
    found.push_back({"freenect:0", false, none.what, none.remedy});
  }
  return found;
}

}  // namespace armsreach
