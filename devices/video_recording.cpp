#include "devices/video_recording.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <opencv2/videoio/registry.hpp>

#include "devices/calibration.hpp"
#include "devices/files.hpp"
#include "devices/image_file.hpp"

namespace armsreach {
namespace {

namespace fs = std::filesystem;

// Going backwards, this many frames are decoded at a time: each seek decodes from the last key
// frame on, so one seek a frame would decode every group of pictures once for each of its frames.
constexpr std::int64_t kChunk = 32;

// A header may round its number of frames; missing more than this is worth saying.
constexpr std::int64_t kRoundedFrames = 2;

class VideoRecording : public Recording {
 public:
  VideoRecording(const fs::path& file, cv::VideoCapture capture, SensorInfo sensor, Events events)
      : file_(file),
        capture_(std::move(capture)),
        sensor_(std::make_shared<const SensorInfo>(std::move(sensor))),
        events_(std::move(events)) {
    const double promised = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    if (promised > 0 && promised < 1e9) size_ = static_cast<std::int64_t>(promised);
  }

  const std::shared_ptr<const SensorInfo>& sensor() const override { return sensor_; }
  std::optional<std::int64_t> size() const override { return size_; }
  Timestamp time(std::int64_t index) const override {
    return timestamp_from_seconds(static_cast<double>(index) / sensor_->rate);
  }
  Events take_events() override { return std::exchange(events_, {}); }

  Result<std::optional<Frame>> read(std::int64_t index) override {
    const cv::Mat image = image_at(index);
    if (image.empty()) {
      note_early_end(index);
      return std::optional<Frame>();
    }
    Frame frame;
    frame.index = index;
    frame.time = time(index);
    frame.color = image;
    frame.sensor = sensor_;
    return std::optional<Frame>(std::move(frame));
  }

 private:
  // Empty from the end on.
  cv::Mat image_at(std::int64_t index) {
    if (index == next_) {
      chunk_.clear();
      return decode_next();
    }
    const bool in_chunk = index >= next_ - std::ssize(chunk_) && index < next_;
    if (!in_chunk) decode_chunk_to(index);
    const std::int64_t in = index - (next_ - std::ssize(chunk_));
    return in < std::ssize(chunk_) ? chunk_[static_cast<std::size_t>(in)] : cv::Mat();
  }

  void decode_chunk_to(std::int64_t last) {
    chunk_.clear();
    next_ = std::max<std::int64_t>(0, last - kChunk + 1);
    capture_.set(cv::CAP_PROP_POS_FRAMES, static_cast<double>(next_));
    while (next_ <= last) {
      const cv::Mat image = decode_next();
      if (image.empty()) return;
      chunk_.push_back(image);
    }
  }

  cv::Mat decode_next() {
    cv::Mat image;  // a new one each time: frames share their images with whoever keeps them
    if (!capture_.read(image)) return {};
    ++next_;
    return image;
  }

  void note_early_end(std::int64_t index) {
    if (!size_ || index + kRoundedFrames >= *size_) return;
    FaultEvent fault{"video:" + file_.string(),
                     "ends after " + std::to_string(index) + " of the " + std::to_string(*size_) +
                         " frames that its header promises",
                     "copy the file again"};
    events_.push_back({time(index), std::move(fault)});
    size_ = index;
  }

  fs::path file_;
  cv::VideoCapture capture_;
  std::shared_ptr<const SensorInfo> sensor_;
  Events events_;
  std::optional<std::int64_t> size_;
  std::int64_t next_ = 0;       // what the capture delivers next
  std::vector<cv::Mat> chunk_;  // the frames just before that
};

}  // namespace

Result<std::unique_ptr<Recording>> open_video_recording(const fs::path& file,
                                                        const OpenOptions& options) {
  if (!file_exists(file) || folder_exists(file)) {
    return Error{"no such file", file.string(), "give a video file; for a folder use images:DIR"};
  }
  cv::VideoCapture capture(file.string(), cv::CAP_FFMPEG);
  const int width = static_cast<int>(capture.get(cv::CAP_PROP_FRAME_WIDTH));
  const int height = static_cast<int>(capture.get(cv::CAP_PROP_FRAME_HEIGHT));
  if (!capture.isOpened() || width <= 0 || height <= 0) {
    return Error{"not a readable video", file.string(),
                 "copy it again, or convert it: ffmpeg -i FILE -c:v libx264 out.mp4"};
  }
  auto calibration = calibration_or_guess(options, file.parent_path() / "camera.yaml", width,
                                          height, "video:" + file.string());
  if (!calibration) return std::move(calibration).error();
  const auto fits = check_size({width, height}, calibration->camera, "colour", file);
  if (!fits) return fits.error();
  SensorInfo sensor;
  sensor.name = options.sensor;
  sensor.color_camera = calibration->camera;
  const double rate = capture.get(cv::CAP_PROP_FPS);
  if (rate > 1e-3 && rate < 1e4) sensor.rate = rate;
  return std::make_unique<VideoRecording>(file, std::move(capture), std::move(sensor),
                                          std::move(calibration->events));
}

Availability probe_video() {
  const auto backends = cv::videoio_registry::getStreamBackends();
  const bool usable = std::find(backends.begin(), backends.end(), cv::CAP_FFMPEG) != backends.end();
  if (usable) return {"video:FILE", true, "a video file, decoded by FFmpeg", ""};
  return {"video:FILE", false, "this OpenCV has no FFmpeg", "sudo apt-get install libopencv-dev"};
}

}  // namespace armsreach
