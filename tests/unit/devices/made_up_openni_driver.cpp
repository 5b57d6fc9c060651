// A driver module of OpenNI2 with one made-up sensor that tests plug in and out: the library itself
// then runs as with a real one, hot-plugging and recording included.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <thread>

// The driver header's export macro uses these from a header that is not installed.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)

#include <Driver/OniDriverAPI.h>

#include "tests/unit/devices/made_up_openni_driver.hpp"

namespace armsreach::test {
namespace {

using namespace std::chrono_literals;

class MadeUpStream : public oni::driver::StreamBase {
 public:
  explicit MadeUpStream(OniSensorType type) : type_(type) {}

  OniStatus start() override {
    running_ = true;
    return ONI_STATUS_OK;
  }
  void stop() override { running_ = false; }

  OniBool isPropertySupported(int id) override {
    int size = 256;
    char value[256];
    return getProperty(id, value, &size) == ONI_STATUS_OK;
  }

  OniStatus getProperty(int id, void* data, int* size) override {
    switch (id) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return give(mode(), data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return give(kMadeUpFieldOfView, data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return give(kMadeUpVerticalFieldOfView, data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give(OniBool{FALSE}, data, size);
      case ONI_STREAM_PROPERTY_STRIDE:
        return give(stride(), data, size);
      case ONI_STREAM_PROPERTY_MAX_VALUE:
        return give(10000, data, size);
      case ONI_STREAM_PROPERTY_CROPPING:
        return give(OniCropping{}, data, size);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }
  OniStatus setProperty(int id, const void*, int) override {
    return id == ONI_STREAM_PROPERTY_VIDEO_MODE ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
  }

  OniVideoMode mode() const {
    return {type_ == ONI_SENSOR_DEPTH ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888,
            kMadeUpWidth, kMadeUpHeight, 30};
  }

  void produce(int number, bool registered) {
    if (!running_) return;
    OniFrame* frame = getServices().acquireFrame();
    if (!frame) return;
    frame->sensorType = type_;
    frame->frameIndex = number + 1;
    frame->timestamp = static_cast<std::uint64_t>(kMadeUpPeriod * number + kMadeUpPeriod) +
                       (type_ == ONI_SENSOR_COLOR ? kMadeUpColorDelay : 0);
    frame->videoMode = mode();
    frame->width = kMadeUpWidth;
    frame->height = kMadeUpHeight;
    frame->croppingEnabled = FALSE;
    frame->stride = stride();
    frame->dataSize = stride() * kMadeUpHeight;
    for (int y = 0; y < kMadeUpHeight; ++y) {
      for (int x = 0; x < kMadeUpWidth; ++x) put(frame, x, y, number, registered);
    }
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }

 private:
  template <class T>
  static OniStatus give(const T& value, void* data, int* size) {
    if (*size < static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
    std::memcpy(data, &value, sizeof value);
    *size = sizeof value;
    return ONI_STATUS_OK;
  }

  int stride() const { return kMadeUpWidth * (type_ == ONI_SENSOR_DEPTH ? 2 : 3); }

  void put(OniFrame* frame, int x, int y, int number, bool registered) const {
    auto* row = static_cast<std::uint8_t*>(frame->data) + y * stride();
    if (type_ == ONI_SENSOR_DEPTH) {
      const std::uint16_t millimetres = made_up_depth(x, y, number, registered);
      std::memcpy(row + 2 * x, &millimetres, 2);
      return;
    }
    row[3 * x] = made_up_red(number);
    row[3 * x + 1] = static_cast<std::uint8_t>(x);
    row[3 * x + 2] = static_cast<std::uint8_t>(y);
  }

  const OniSensorType type_;
  std::atomic<bool> running_ = false;
};

class MadeUpDevice : public oni::driver::DeviceBase {
 public:
  MadeUpDevice() {
    for (int i = 0; i < 2; ++i) {
      modes_[i] = MadeUpStream(i == 0 ? ONI_SENSOR_DEPTH : ONI_SENSOR_COLOR).mode();
      sensors_[i] = {i == 0 ? ONI_SENSOR_DEPTH : ONI_SENSOR_COLOR, 1, &modes_[i]};
    }
    producer_ = std::thread([this] { produce(); });
  }
  ~MadeUpDevice() override {
    stopping_ = true;
    producer_.join();
  }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_;
    *count = 2;
    return ONI_STATUS_OK;
  }
  oni::driver::StreamBase* createStream(OniSensorType type) override {
    const std::lock_guard lock(mutex_);
    std::unique_ptr<MadeUpStream>& stream = type == ONI_SENSOR_DEPTH ? depth_ : color_;
    stream = std::make_unique<MadeUpStream>(type);
    return stream.get();
  }
  void destroyStream(oni::driver::StreamBase* stream) override {
    const std::lock_guard lock(mutex_);
    (stream == depth_.get() ? depth_ : color_).reset();
  }

  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override { return TRUE; }
  OniBool isPropertySupported(int id) override {
    return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
  }
  OniStatus setProperty(int id, const void* data, int) override {
    if (!isPropertySupported(id)) return ONI_STATUS_NOT_SUPPORTED;
    OniImageRegistrationMode mode;
    std::memcpy(&mode, data, sizeof mode);
    registered_ = mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    return ONI_STATUS_OK;
  }
  OniStatus getProperty(int id, void* data, int* size) override {
    if (!isPropertySupported(id)) return ONI_STATUS_NOT_SUPPORTED;
    const auto mode =
        registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF;
    std::memcpy(data, &mode, sizeof mode);
    *size = sizeof mode;
    return ONI_STATUS_OK;
  }

  void unplug() { plugged_ = false; }

 private:
  void produce() {
    for (int number = 0; !stopping_; ++number) {
      std::this_thread::sleep_for(5ms);
      const std::lock_guard lock(mutex_);
      if (!plugged_) continue;
      if (depth_) depth_->produce(number, registered_);
      if (color_) color_->produce(number, registered_);
    }
  }

  OniVideoMode modes_[2];
  OniSensorInfo sensors_[2];
  std::mutex mutex_;
  std::unique_ptr<MadeUpStream> depth_;
  std::unique_ptr<MadeUpStream> color_;
  std::atomic<bool> registered_ = false;
  std::atomic<bool> plugged_ = true;
  std::atomic<bool> stopping_ = false;
  std::thread producer_;
};

OniDeviceInfo made_up_info() {
  OniDeviceInfo info{};
  std::strcpy(info.uri, kMadeUpUri);
  std::strcpy(info.vendor, "Nobody");
  std::strcpy(info.name, "made-up sensor");
  return info;
}

class MadeUpDriver : public oni::driver::DriverBase {
 public:
  explicit MadeUpDriver(OniDriverServices* services) : DriverBase(services) { instance() = this; }
  ~MadeUpDriver() override { instance() = nullptr; }
  static MadeUpDriver*& instance() {
    static MadeUpDriver* driver = nullptr;
    return driver;
  }

  void plug(bool in) {
    const OniDeviceInfo info = made_up_info();
    plugged_ = in;
    if (in) {
      deviceConnected(&info);
    } else {
      if (device_) device_->unplug();
      deviceDisconnected(&info);
    }
  }

  oni::driver::DeviceBase* deviceOpen(const char*, const char*) override {
    if (!plugged_) return nullptr;
    device_ = std::make_unique<MadeUpDevice>();
    return device_.get();
  }
  void deviceClose(oni::driver::DeviceBase*) override { device_.reset(); }
  void shutdown() override {}

 private:
  bool plugged_ = false;
  std::unique_ptr<MadeUpDevice> device_;
};

}  // namespace
}  // namespace armsreach::test

ONI_EXPORT_DRIVER(armsreach::test::MadeUpDriver)

extern "C" void made_up_sensor_plug(bool in) {
  if (auto* driver = armsreach::test::MadeUpDriver::instance()) driver->plug(in);
}
