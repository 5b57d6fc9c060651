// `openni:FILE.oni`: a recording, read through OpenNI2's own player.
#include <algorithm>
#include <cstdlib>
#include <deque>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "devices/depth_camera.hpp"
#include "devices/files.hpp"
#include "devices/openni.hpp"
#include "devices/openni_streams.hpp"

namespace armsreach {
namespace {

constexpr float kWhenAsked = -1;    // the player's speed: an image at a time, when it is read
constexpr int kLongestWait = 2000;  // ms; the player says nothing at a damaged place
constexpr Timestamp kPairingTolerance = 20'000'000;  // ns, as of TUM recordings

// Going backwards, this many frames are read at a time: the player seeks by reading one image of
// every stream, so that the ones after it come in order.
constexpr std::int64_t kChunk = 8;
constexpr std::size_t kMostKept = 2 * kChunk + 4;  // images of a kind: a chunk at twice the rate
constexpr int kMostReads = 6 * kChunk;             // for one image, in a file that is sound

struct Streams {
  std::shared_ptr<OpenNiLibrary> library;  // goes last
  openni::Device device;
  openni::VideoStream depth;
  openni::VideoStream color;  // invalid where there is none
};

struct ReadImage {
  std::int64_t index = 0;  // of depth
  Timestamp time = 0;
  cv::Mat image;
};

// The player gives images in the order in which they were recorded, each once: those around the
// present one are kept.
class OniPlayer {
 public:
  explicit OniPlayer(std::unique_ptr<Streams> streams)
      : streams_(std::move(streams)),
        depth_mirrored_(streams_->depth.getMirroringEnabled()),
        color_mirrored_(has_color() && streams_->color.getMirroringEnabled()) {}

  bool has_color() const { return streams_->color.isValid(); }
  // Null when the player cannot give it.
  const ReadImage* depth(std::int64_t index);
  const ReadImage* color_near(Timestamp time);

 private:
  const ReadImage* kept_depth(std::int64_t index) const;
  const ReadImage* kept_color(Timestamp time) const;
  bool seek(std::int64_t index);
  bool pump();

  std::unique_ptr<Streams> streams_;
  // Asked for once: at its end the player locks its properties until it is asked for more images.
  const bool depth_mirrored_;
  const bool color_mirrored_;
  std::int64_t next_ = 0;  // depth image to come
  std::deque<ReadImage> depth_;
  std::deque<ReadImage> color_;
  std::optional<Timestamp> newest_color_;  // since the last seek
};

const ReadImage* OniPlayer::depth(std::int64_t index) {
  if (const ReadImage* kept = kept_depth(index)) return kept;
  if (index < next_ && !seek(std::max<std::int64_t>(0, index - kChunk + 1))) return nullptr;
  if (index > next_ && !seek(index)) return nullptr;
  for (int reads = 0; reads < kMostReads; ++reads) {
    if (const ReadImage* kept = kept_depth(index)) return kept;
    if (next_ > index && !seek(index)) return nullptr;  // one was dropped
    if (!pump()) return nullptr;
  }
  return kept_depth(index);
}

const ReadImage* OniPlayer::color_near(Timestamp time) {
  for (int reads = 0; reads < kMostReads; ++reads) {
    if (const ReadImage* kept = kept_color(time)) return kept;
    if (newest_color_ && *newest_color_ > time + kPairingTolerance) return nullptr;
    if (!pump()) return nullptr;
  }
  return nullptr;
}

const ReadImage* OniPlayer::kept_depth(std::int64_t index) const {
  for (const ReadImage& kept : depth_) {
    if (kept.index == index) return &kept;
  }
  return nullptr;
}

const ReadImage* OniPlayer::kept_color(Timestamp time) const {
  const ReadImage* best = nullptr;
  for (const ReadImage& kept : color_) {
    const Timestamp apart = std::abs(kept.time - time);
    if (apart > kPairingTolerance) continue;
    if (!best || apart < std::abs(best->time - time)) best = &kept;
  }
  return best;
}

// Afterwards the image at `index` has been read, and the one after it comes next.
bool OniPlayer::seek(std::int64_t index) {
  depth_.clear();
  color_.clear();
  const int number = static_cast<int>(index) + 1;  // the player counts from one
  if (streams_->device.getPlaybackControl()->seek(streams_->depth, number) != openni::STATUS_OK) {
    return false;
  }
  for (int reads = 0; reads < kMostReads && !kept_depth(index); ++reads) {
    if (!pump()) return false;
  }
  newest_color_.reset();  // what came may have been waiting from before
  return kept_depth(index) != nullptr;
}

bool OniPlayer::pump() {
  openni::VideoStream* const streams[] = {&streams_->depth, &streams_->color};
  int ready = 0;
  openni::VideoFrameRef frame;
  if (openni::OpenNI::waitForAnyStream(const_cast<openni::VideoStream**>(streams),
                                       has_color() ? 2 : 1, &ready,
                                       kLongestWait) != openni::STATUS_OK ||
      streams[ready]->readFrame(&frame) != openni::STATUS_OK) {
    return false;
  }
  const bool is_depth = ready == 0;
  auto image = is_depth ? depth_image(frame, depth_mirrored_) : color_image(frame, color_mirrored_);
  if (!image) return false;
  const ReadImage read{frame.getFrameIndex() - 1, frame_time(frame), std::move(*image)};
  std::deque<ReadImage>& kept = is_depth ? depth_ : color_;
  kept.push_back(read);
  if (kept.size() > kMostKept) kept.pop_front();
  if (is_depth) {
    next_ = read.index + 1;
  } else {
    newest_color_ = read.time;
  }
  return true;
}

class OniRecording : public Recording {
 public:
  OniRecording(const std::string& file, std::unique_ptr<Streams> streams, std::int64_t size,
               SensorInfo sensor, Events events)
      : file_(file),
        player_(std::move(streams)),
        size_(size),
        sensor_(std::make_shared<const SensorInfo>(std::move(sensor))),
        events_(std::move(events)) {}

  const std::shared_ptr<const SensorInfo>& sensor() const override { return sensor_; }
  std::optional<std::int64_t> size() const override { return size_; }
  Events take_events() override { return std::exchange(events_, {}); }

  // Known up to the last frame read; beyond it, what the rate says.
  Timestamp time(std::int64_t index) const override {
    const auto known = static_cast<std::int64_t>(times_.size());
    if (index < known) return times_[static_cast<std::size_t>(index)];
    const Timestamp last = times_.empty() ? 0 : times_.back();
    return last + timestamp_from_seconds(static_cast<double>(index - known + 1) / sensor_->rate);
  }

  Result<std::optional<Frame>> read(std::int64_t index) override {
    if (index >= size_) return std::optional<Frame>();
    const ReadImage* depth = player_.depth(index);
    if (!depth) {
      end_at(index);
      return std::optional<Frame>();
    }
    Frame frame;
    frame.depth = depth->image;
    note_time(index, depth->time);
    if (player_.has_color()) {
      const ReadImage* color = player_.color_near(depth->time);
      if (!color) {
        return Error{"depth image " + std::to_string(index) + " has no colour image within 20 ms",
                     file_, "it is left out"};
      }
      frame.color = color->image;
    }
    frame.index = index;
    frame.time = time(index);
    frame.sensor = sensor_;
    return std::optional<Frame>(std::move(frame));
  }

 private:
  // Times increase, whatever the file says.
  void note_time(std::int64_t index, Timestamp recorded) {
    while (std::ssize(times_) < index) times_.push_back(time(std::ssize(times_)));
    if (index < std::ssize(times_)) return;
    times_.push_back(times_.empty() ? recorded : std::max(recorded, times_.back() + 1));
  }

  void end_at(std::int64_t index) {
    FaultEvent fault{"openni:" + file_,
                     "ends after " + std::to_string(index) + " of the " + std::to_string(size_) +
                         " frames that its header promises",
                     "copy the file again"};
    events_.push_back({time(index), std::move(fault)});
    size_ = index;
  }

  std::string file_;
  OniPlayer player_;
  std::int64_t size_;
  std::shared_ptr<const SensorInfo> sensor_;
  Events events_;
  std::vector<Timestamp> times_;
};

Result<std::unique_ptr<Streams>> open_streams(const std::string& file) {
  auto library = OpenNiLibrary::start();
  if (!library) return std::move(library).error();
  auto streams = std::make_unique<Streams>();
  streams->library = std::move(*library);
  const auto failed = [&file](const std::string& what) {
    return Error{what, file, "copy it again, or record it again with OpenNI2"};
  };
  if (streams->device.open(file.c_str()) != openni::STATUS_OK || !streams->device.isFile()) {
    return failed("not a recording of OpenNI2");
  }
  if (!streams->device.hasSensor(openni::SENSOR_DEPTH) ||
      streams->depth.create(streams->device, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
    return failed("holds no depth");
  }
  if (streams->device.hasSensor(openni::SENSOR_COLOR) &&
      streams->color.create(streams->device, openni::SENSOR_COLOR) != openni::STATUS_OK) {
    return failed("its colour cannot be read");
  }
  openni::PlaybackControl* playback = streams->device.getPlaybackControl();
  // At its end a player that does not repeat refuses to seek, and so to turn round.
  if (playback->setSpeed(kWhenAsked) != openni::STATUS_OK ||
      playback->setRepeatEnabled(true) != openni::STATUS_OK ||
      streams->depth.start() != openni::STATUS_OK ||
      (streams->color.isValid() && streams->color.start() != openni::STATUS_OK)) {
    return failed("does not play");
  }
  return streams;
}

}  // namespace

Result<std::unique_ptr<Recording>> open_oni_recording(const std::string& file,
                                                      const OpenOptions& options,
                                                      std::optional<bool> registration) {
  if (!file_exists(file) || folder_exists(file)) {
    return Error{"no such file", file, "give a recording of OpenNI2, openni:FILE.oni"};
  }
  auto streams = open_streams(file);
  if (!streams) return std::move(streams).error();
  const int size = (*streams)->device.getPlaybackControl()->getNumberOfFrames((*streams)->depth);
  if (size <= 0) {
    return Error{"holds no depth images", file, "record it again; a recording must be closed"};
  }
  auto described =
      sensor_of_streams((*streams)->depth, (*streams)->color, registration.value_or(true));
  described.sensor.registration_stated = registration.has_value();
  auto calibrated = calibrate_depth_camera(std::move(described.sensor), described.nominal, options,
                                           "openni:" + file);
  if (!calibrated) return std::move(calibrated).error();
  return std::make_unique<OniRecording>(file, std::move(*streams), size,
                                        std::move(calibrated->sensor),
                                        std::move(calibrated->events));
}

}  // namespace armsreach
