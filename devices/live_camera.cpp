#include "devices/live_camera.hpp"

#include <atomic>
#include <utility>

namespace armsreach {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kStopLatency = 50ms;
constexpr auto kLongestSilence = 2s;  // the slowest webcam exposes for half a second in the dark

class LiveCamera : public Source {
 public:
  LiveCamera(std::unique_ptr<CameraDriver> driver, const std::string& place, SensorInfo sensor,
             Events events)
      : driver_(std::move(driver)),
        place_(place),
        sensor_(std::make_shared<const SensorInfo>(std::move(sensor))),
        events_(std::move(events)) {}

  const std::shared_ptr<const SensorInfo>& sensor() const override { return sensor_; }
  void stop() override { stopped_ = true; }
  Events take_events() override { return std::exchange(events_, {}); }
  bool live() const override { return true; }

  Result<FramePtr> next() override {
    const auto deadline = Clock::now() + kLongestSilence;
    while (!stopped_) {
      switch (driver_->wait(kStopLatency)) {
        case CameraDriver::State::ready:
          return capture();
        case CameraDriver::State::gone:
          return device_error("the camera has gone");
        case CameraDriver::State::waiting:
          if (Clock::now() >= deadline) return device_error("the camera is silent");
      }
    }
    return FramePtr();
  }

 private:
  Result<FramePtr> capture() {
    auto frame = std::make_shared<Frame>();
    frame->time = std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
    frame->color = driver_->read();
    if (frame->color.empty()) return device_error("the camera gives no image");
    const Camera& camera = sensor_->camera();
    if (frame->color.cols != camera.width || frame->color.rows != camera.height) {
      return device_error("the camera has changed its image size");
    }
    frame->index = captured_++;
    frame->sensor = sensor_;
    return FramePtr(std::move(frame));
  }

  Error device_error(const std::string& what) const {
    return {what, place_, "check its cable and start again", Error::Kind::device};
  }

  std::unique_ptr<CameraDriver> driver_;
  std::string place_;
  std::shared_ptr<const SensorInfo> sensor_;
  Events events_;
  std::int64_t captured_ = 0;
  std::atomic<bool> stopped_ = false;
};

}  // namespace

std::unique_ptr<Source> live_camera(std::unique_ptr<CameraDriver> driver, const std::string& place,
                                    SensorInfo sensor, Events events) {
  return std::make_unique<LiveCamera>(std::move(driver), place, std::move(sensor),
                                      std::move(events));
}

}  // namespace armsreach
