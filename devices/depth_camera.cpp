#include "devices/depth_camera.hpp"

#include <chrono>
#include <condition_variable>
#include <iomanip>
#include <mutex>
#include <optional>
#include <sstream>
#include <utility>

#include "devices/calibration.hpp"
#include "devices/image_file.hpp"
#include "devices/image_pairs.hpp"

namespace armsreach {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kLongestSilence = 3s;  // a Kinect takes two to deliver its first image
constexpr auto kRetry = 1s;           // for drivers that do not tell of a device's arrival

Timestamp now() { return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count(); }

bool same_size(const std::optional<Camera>& a, const std::optional<Camera>& b) {
  return a.has_value() == b.has_value() && (!a || (a->width == b->width && a->height == b->height));
}

class DepthCamera : public Source, private DepthCameraListener {
 public:
  DepthCamera(std::unique_ptr<DepthCameraDriver> driver, const std::string& place)
      : place_(place), driver_(std::move(driver)) {}
  ~DepthCamera() override { driver_->close(); }

  Status start(const OpenOptions& options);

  const std::shared_ptr<const SensorInfo>& sensor() const override { return sensor_; }
  bool live() const override { return true; }
  Events take_events() override { return std::exchange(events_, {}); }
  Result<FramePtr> next() override;

  void stop() override {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
  }

 private:
  void on_color(cv::Mat color, Timestamp time) override;
  void on_depth(cv::Mat depth, Timestamp time) override;
  void on_gone(const std::string& what) override;
  void on_arrival() override;

  std::optional<Error> close_lost(std::unique_lock<std::mutex>& lock);
  std::optional<Error> reopen_when_back(std::unique_lock<std::mutex>& lock);
  std::optional<Error> once(const std::string& complaint, const std::string& remedy);
  FramePtr frame_of(ImagePair pair);
  void note(const std::string& message, const std::string& remedy);

  std::string place_;
  std::shared_ptr<const SensorInfo> sensor_;
  Events events_;
  std::int64_t captured_ = 0;
  bool streaming_ = false;
  std::optional<Clock::time_point> away_since_;  // until an image comes again
  std::string last_complaint_;

  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::optional<ImagePairs> pairs_;  // absent for a camera without colour
  std::optional<ImagePair> newest_;
  std::optional<std::string> gone_;
  bool arrived_ = false;
  bool stopped_ = false;

  std::unique_ptr<DepthCameraDriver> driver_;  // goes first: its threads call the above
};

void DepthCamera::on_color(cv::Mat color, Timestamp time) {
  const std::lock_guard lock(mutex_);
  if (!pairs_) return;
  if (auto pair = pairs_->add_color({std::move(color), time, now()})) newest_ = std::move(pair);
  if (newest_) changed_.notify_all();
}

void DepthCamera::on_depth(cv::Mat depth, Timestamp time) {
  const std::lock_guard lock(mutex_);
  TimedImage image{std::move(depth), time, now()};
  if (!pairs_) {
    newest_ = ImagePair{{}, std::move(image)};
  } else if (auto pair = pairs_->add_depth(std::move(image))) {
    newest_ = std::move(pair);
  }
  if (newest_) changed_.notify_all();
}

void DepthCamera::on_gone(const std::string& what) {
  const std::lock_guard lock(mutex_);
  gone_ = what;
  changed_.notify_all();
}

void DepthCamera::on_arrival() {
  const std::lock_guard lock(mutex_);
  arrived_ = true;
  changed_.notify_all();
}

Status DepthCamera::start(const OpenOptions& options) {
  {
    const std::lock_guard lock(mutex_);
    pairs_.emplace(SensorInfo().rate);  // so that nothing is taken for a frame before it is one
  }
  auto opened = driver_->open(*this);
  if (!opened) return std::move(opened).error();
  auto calibrated =
      calibrate_depth_camera(std::move(opened->sensor), opened->nominal, options, place_);
  if (!calibrated) return std::move(calibrated).error();
  sensor_ = std::make_shared<const SensorInfo>(std::move(calibrated->sensor));
  events_ = std::move(opened->events);
  events_.insert(events_.end(), calibrated->events.begin(), calibrated->events.end());
  streaming_ = true;
  const std::lock_guard lock(mutex_);
  newest_.reset();
  pairs_.reset();
  if (sensor_->color_camera) pairs_.emplace(sensor_->rate);
  return ok();
}

Result<FramePtr> DepthCamera::next() {
  std::unique_lock lock(mutex_);
  while (!stopped_) {
    if (!streaming_) {
      if (auto error = reopen_when_back(lock)) return *error;
      continue;
    }
    changed_.wait_for(lock, kLongestSilence, [this] { return stopped_ || newest_ || gone_; });
    if (stopped_) break;
    if (newest_) return frame_of(*std::exchange(newest_, std::nullopt));
    if (auto error = close_lost(lock)) return *error;
  }
  return FramePtr();
}

// The complaint, the first time since images last came.
std::optional<Error> DepthCamera::close_lost(std::unique_lock<std::mutex>& lock) {
  const std::string what = gone_.value_or("is silent");
  lock.unlock();
  driver_->close();
  lock.lock();
  streaming_ = false;
  if (away_since_) return std::nullopt;  // it came back and gave nothing
  away_since_ = Clock::now();
  return once(what, "plug it in again: it is waited for");
}

std::optional<Error> DepthCamera::reopen_when_back(std::unique_lock<std::mutex>& lock) {
  changed_.wait_for(lock, kRetry, [this] { return stopped_ || arrived_; });
  if (stopped_) return std::nullopt;
  arrived_ = false;
  gone_.reset();
  newest_.reset();
  if (pairs_) pairs_.emplace(sensor_->rate);
  lock.unlock();
  auto opened = driver_->open(*this);
  const bool fits = opened && same_size(opened->sensor.color_camera, sensor_->color_camera) &&
                    same_size(opened->sensor.depth_camera, sensor_->depth_camera);
  if (opened && !fits) driver_->close();
  lock.lock();
  streaming_ = fits;
  if (fits) return std::nullopt;
  if (!opened) return once(opened.error().what, opened.error().remedy);
  return once("another device came, with images of other sizes", "plug in the one from before");
}

// An error that the reader asks again after; not the same one twice.
std::optional<Error> DepthCamera::once(const std::string& complaint, const std::string& remedy) {
  if (std::exchange(last_complaint_, complaint) == complaint) return std::nullopt;
  return Error{complaint, place_, remedy, Error::Kind::away};
}

FramePtr DepthCamera::frame_of(ImagePair pair) {
  if (away_since_) {
    const std::chrono::duration<double> away = Clock::now() - *away_since_;
    std::ostringstream message;
    message << "is back after " << std::fixed << std::setprecision(1) << away.count() << " s";
    note(message.str(), "nothing needs to be done");
    away_since_.reset();
    last_complaint_.clear();
  }
  auto frame = std::make_shared<Frame>();
  frame->index = captured_++;
  frame->time = pair.depth.arrival;
  frame->color = std::move(pair.color.image);
  frame->depth = std::move(pair.depth.image);
  frame->sensor = sensor_;
  return frame;
}

void DepthCamera::note(const std::string& message, const std::string& remedy) {
  events_.push_back({now(), FaultEvent{place_, message, remedy}});
}

// In place of what the driver knows.
Status use_camera_file(const CameraFile& file, const std::string& place, SensorInfo* sensor) {
  const bool of_color = file.camera_from_depth.has_value();
  if (of_color && (sensor->registered || !sensor->color_camera)) {
    return Error{"colour and depth are registered: there is no colour camera of its own", place,
                 "leave camera_from_depth out of the file given to --camera"};
  }
  std::optional<Camera>& camera = of_color ? sensor->color_camera : sensor->depth_camera;
  auto fits = check_size({camera->width, camera->height}, file.camera,
                         of_color ? "colour" : "depth", place);
  if (!fits) return fits;
  camera = file.camera;
  if (of_color) sensor->color_from_depth = *file.camera_from_depth;
  if (sensor->registered && sensor->color_camera) sensor->color_camera = file.camera;
  return ok();
}

}  // namespace

Result<CalibratedSensor> calibrate_depth_camera(SensorInfo sensor, bool nominal,
                                                const OpenOptions& options,
                                                const std::string& place) {
  CalibratedSensor calibrated;
  sensor.name = options.sensor;
  if (options.camera) {
    auto status = use_camera_file(*options.camera, place, &sensor);
    if (!status) return status.error();
  } else if (nominal) {
    calibrated.events.push_back(
        {0, FaultEvent{place, "no calibration: taking the nominal cameras of its model",
                       "calibrate it and give the camera file with --camera"}});
  }
  calibrated.sensor = std::move(sensor);
  return calibrated;
}

Result<std::unique_ptr<Source>> open_depth_camera(std::unique_ptr<DepthCameraDriver> driver,
                                                  const std::string& place,
                                                  const OpenOptions& options) {
  auto source = std::make_unique<DepthCamera>(std::move(driver), place);
  if (auto status = source->start(options); !status) return status.error();
  return source;
}

}  // namespace armsreach
