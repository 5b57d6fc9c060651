// `openni:any`: a live sensor through OpenNI2.
#include <algorithm>
#include <mutex>
#include <string>
#include <utility>

#include "devices/depth_camera.hpp"
#include "devices/openni.hpp"
#include "devices/openni_streams.hpp"

namespace armsreach {
namespace {

constexpr int kWidth = 640;  // px, of the mode that every such sensor has at 30 Hz
constexpr int kHeight = 480;
constexpr int kRate = 30;                   // Hz
constexpr const char* kUsbGroup = "video";  // that of the distribution's udev rules

bool is_primesense(const UsbDevice& device) { return device.vendor == "1d27"; }

// The usual mode in the given format, or else the first in it.
std::optional<openni::VideoMode> mode_with(const openni::VideoStream& stream,
                                           openni::PixelFormat format) {
  std::optional<openni::VideoMode> first;
  const auto& modes = stream.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    const openni::VideoMode& mode = modes[i];
    if (mode.getPixelFormat() != format) continue;
    if (!first) first = mode;
    const bool usual = mode.getResolutionX() == kWidth && mode.getResolutionY() == kHeight &&
                       mode.getFps() == kRate;
    if (usual) return mode;
  }
  return first;
}

// A driver's thread calls for each new image.
class StreamListener : public openni::VideoStream::NewFrameListener {
 public:
  using Handler = void (*)(DepthCameraListener&, openni::VideoStream&,
                           const openni::VideoFrameRef&);
  StreamListener(DepthCameraListener& listener, Handler handler)
      : listener_(listener), handler_(handler) {}
  void onNewFrame(openni::VideoStream& stream) override {
    openni::VideoFrameRef frame;
    if (stream.readFrame(&frame) == openni::STATUS_OK) handler_(listener_, stream, frame);
  }

 private:
  DepthCameraListener& listener_;
  Handler handler_;
};

void hand_on_depth(DepthCameraListener& listener, openni::VideoStream& stream,
                   const openni::VideoFrameRef& frame) {
  auto depth = depth_image(frame, stream.getMirroringEnabled());
  if (depth) listener.on_depth(std::move(*depth), frame_time(frame));
}

void hand_on_color(DepthCameraListener& listener, openni::VideoStream& stream,
                   const openni::VideoFrameRef& frame) {
  auto color = color_image(frame, stream.getMirroringEnabled());
  if (color) listener.on_color(std::move(*color), frame_time(frame));
}

class OpenNiDriver : public DepthCameraDriver,
                     private openni::OpenNI::DeviceConnectedListener,
                     private openni::OpenNI::DeviceDisconnectedListener {
 public:
  OpenNiDriver(std::shared_ptr<OpenNiLibrary> library, std::string uri, bool registration)
      : library_(std::move(library)), uri_(std::move(uri)), registration_(registration) {
    openni::OpenNI::addDeviceConnectedListener(this);
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }
  ~OpenNiDriver() override {
    openni::OpenNI::removeDeviceConnectedListener(this);
    openni::OpenNI::removeDeviceDisconnectedListener(this);
    close();
  }

  Result<Opened> open(DepthCameraListener& listener) override;
  void close() override;

 private:
  struct Streams {
    Streams(DepthCameraListener& listener)
        : on_depth(listener, hand_on_depth), on_color(listener, hand_on_color) {}
    openni::Device device;
    openni::VideoStream depth;
    openni::VideoStream color;  // invalid where the device has none
    StreamListener on_depth;
    StreamListener on_color;
  };

  Status open_device();
  Status create(openni::SensorType type, openni::PixelFormat format, openni::VideoStream* stream);
  bool registers() const;
  Status start(openni::VideoStream& stream, StreamListener& listener);
  Error failure(const std::string& what) const;
  void onDeviceConnected(const openni::DeviceInfo* info) override;
  void onDeviceDisconnected(const openni::DeviceInfo* info) override;

  std::shared_ptr<OpenNiLibrary> library_;
  const std::string uri_;  // empty: any
  const bool registration_;
  std::unique_ptr<Streams> streams_;

  std::mutex mutex_;  // of what follows: the library's threads read it
  DepthCameraListener* listener_ = nullptr;
  std::string opened_uri_;
};

Result<DepthCameraDriver::Opened> OpenNiDriver::open(DepthCameraListener& listener) {
  {
    const std::lock_guard lock(mutex_);
    listener_ = &listener;
  }
  streams_ = std::make_unique<Streams>(listener);
  auto status = open_device();
  if (status) {
    status = create(openni::SENSOR_DEPTH, openni::PIXEL_FORMAT_DEPTH_1_MM, &streams_->depth);
  }
  if (status && streams_->device.hasSensor(openni::SENSOR_COLOR)) {
    status = create(openni::SENSOR_COLOR, openni::PIXEL_FORMAT_RGB888, &streams_->color);
  }
  Opened opened;
  if (status) {
    const bool registered = registers();
    auto described = sensor_of_streams(streams_->depth, streams_->color, registered);
    opened.sensor = std::move(described.sensor);
    opened.nominal = described.nominal;
    if (registration_ && !registered && streams_->color.isValid()) {
      opened.events.push_back(
          {0, FaultEvent{"openni", "the driver does not register depth to colour",
                         "calibrate both cameras, or take its usual ones as they are"}});
    }
    status = start(streams_->depth, streams_->on_depth);
  }
  if (status && streams_->color.isValid()) status = start(streams_->color, streams_->on_color);
  if (status) return opened;
  close();
  return status.error();
}

void OpenNiDriver::close() {
  {
    const std::lock_guard lock(mutex_);
    opened_uri_.clear();
  }
  if (!streams_) return;
  for (auto [stream, listener] : {std::pair{&streams_->color, &streams_->on_color},
                                  std::pair{&streams_->depth, &streams_->on_depth}}) {
    if (!stream->isValid()) continue;
    stream->stop();
    stream->removeNewFrameListener(listener);
    stream->destroy();
  }
  streams_->device.close();
  streams_.reset();
}

Status OpenNiDriver::open_device() {
  const char* uri = uri_.empty() ? openni::ANY_DEVICE : uri_.c_str();
  if (streams_->device.open(uri) != openni::STATUS_OK) return failure("cannot be opened");
  const std::lock_guard lock(mutex_);
  opened_uri_ = streams_->device.getDeviceInfo().getUri();
  return ok();
}

Status OpenNiDriver::create(openni::SensorType type, openni::PixelFormat format,
                            openni::VideoStream* stream) {
  if (stream->create(streams_->device, type) != openni::STATUS_OK) {
    return failure(type == openni::SENSOR_DEPTH ? "has no depth stream" : "has no colour stream");
  }
  const auto mode = mode_with(*stream, format);
  if (!mode || stream->setVideoMode(*mode) != openni::STATUS_OK) {
    return failure("does not stream millimetres and RGB");
  }
  stream->setMirroringEnabled(false);  // where it stays on, images are turned back
  return ok();
}

// Asks for registration; what counts is what the driver then says.
bool OpenNiDriver::registers() const {
  openni::Device& device = streams_->device;
  const auto wanted =
      registration_ ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR : openni::IMAGE_REGISTRATION_OFF;
  if (device.isImageRegistrationModeSupported(wanted)) device.setImageRegistrationMode(wanted);
  device.setDepthColorSyncEnabled(true);  // those that cannot are paired by time all the same
  return device.getImageRegistrationMode() == openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
}

Status OpenNiDriver::start(openni::VideoStream& stream, StreamListener& listener) {
  if (stream.addNewFrameListener(&listener) == openni::STATUS_OK &&
      stream.start() == openni::STATUS_OK) {
    return ok();
  }
  return failure("does not start to stream");
}

// What USB says of the device is worth more than the library's "it failed".
Error OpenNiDriver::failure(const std::string& what) const {
  Error error{openni_complaint(what), "openni:" + (uri_.empty() ? "any" : uri_),
              "close other programs that use it, then plug it in again", Error::Kind::device};
  const std::vector<UsbDevice> devices = usb_devices();
  const auto sensor = std::find_if(devices.begin(), devices.end(), is_primesense);
  openni::Array<openni::DeviceInfo> seen;
  openni::OpenNI::enumerateDevices(&seen);
  if (sensor != devices.end()) {
    if (const auto obstacle = usb_obstacle(*sensor, kUsbGroup)) {
      error.what = what + ": " + obstacle->what;
      error.remedy = obstacle->remedy;
    }
  } else if (seen.getSize() == 0) {
    const UsbObstacle none = usb_absence("no OpenNI2 sensor is plugged in", "plug it in");
    error.what = none.what;
    error.remedy = none.remedy;
  }
  return error;
}

void OpenNiDriver::onDeviceConnected(const openni::DeviceInfo*) {
  const std::lock_guard lock(mutex_);
  if (listener_) listener_->on_arrival();
}

void OpenNiDriver::onDeviceDisconnected(const openni::DeviceInfo* info) {
  const std::lock_guard lock(mutex_);
  if (listener_ && opened_uri_ == info->getUri()) listener_->on_gone("the sensor has gone");
}

}  // namespace

Result<std::unique_ptr<Source>> open_openni_camera(const SourceSpec& spec,
                                                   const OpenOptions& options, bool registration) {
  auto library = OpenNiLibrary::start();
  if (!library) return std::move(library).error();
  return open_depth_camera(
      std::make_unique<OpenNiDriver>(std::move(*library), spec.place == "any" ? "" : spec.place,
                                     registration),
      text_of(spec), options);
}

std::vector<Availability> probe_openni(const std::vector<UsbDevice>& devices) {
  std::vector<Availability> found;
  const auto library = OpenNiLibrary::start();
  if (!library) {
    found.push_back({"openni:any", false, library.error().what, library.error().remedy});
    return found;
  }
  openni::Array<openni::DeviceInfo> seen;
  openni::OpenNI::enumerateDevices(&seen);
  for (int i = 0; i < seen.getSize(); ++i) {
    const std::string spec = "openni:" + (i == 0 ? std::string("any") : seen[i].getUri());
    const std::string name = std::string(seen[i].getVendor()) + " " + seen[i].getName();
    found.push_back({spec, true, name, ""});
  }
  for (const UsbDevice& device : devices) {
    if (!is_primesense(device)) continue;
    if (const auto obstacle = usb_obstacle(device, kUsbGroup)) {
      found.push_back({"openni:any", false, obstacle->what, obstacle->remedy});
    }
  }
  if (found.empty()) {
    const UsbObstacle none = usb_absence("no OpenNI2 sensor is plugged in", "plug it in");
    found.push_back({"openni:any", false, none.what, none.remedy});
  }
  found.push_back({"openni:FILE.oni", true, "a recording of OpenNI2", ""});
  return found;
}

}  // namespace armsreach
