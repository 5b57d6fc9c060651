#include "render/recorder.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "render/film_sound.hpp"

namespace armsreach::render {
namespace {

// With less than this left on the disk recording stops, while there is room to finish the file.
constexpr std::uintmax_t kLeastSpace = 16U << 20;  // bytes
constexpr std::int64_t kFramesBetweenChecks = 30;

Status can_be_written(const std::filesystem::path& file) {
  errno = 0;
  const std::ofstream attempt(file, std::ios::binary | std::ios::app);
  if (attempt) return ok();
  return Error{std::string("cannot be written: ") + std::strerror(errno), file.string(),
               "name a file in an existing folder that you may write to"};
}

Error disk_full(const std::filesystem::path& file) {
  return {"the disk is full", file.string(),
          "free some space or record elsewhere; what was recorded before is kept",
          Error::Kind::device};
}

bool space_left(const std::filesystem::path& file) {
  std::error_code error;
  const auto folder = std::filesystem::absolute(file).parent_path();
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  return error || space.available >= kLeastSpace;
}

}  // namespace

struct Recorder::Encoder {
  cv::VideoWriter writer;
};

Result<std::unique_ptr<Recorder>> Recorder::open(const RecordingOptions& options) {
  const std::string where = options.file.string();
  if (options.file.extension() != ".mp4")
    return Error{"recordings are H.264 in mp4", where, "give a name that ends in .mp4"};
  if (options.width <= 0 || options.height <= 0 || options.width % 2 || options.height % 2)
    return Error{"cannot record " + std::to_string(options.width) + "x" +
                     std::to_string(options.height) + " px",
                 where, "give the picture an even width and height"};
  if (const Status writable = can_be_written(options.file); !writable) return writable.error();
  if (!space_left(options.file)) return disk_full(options.file);
  std::unique_ptr<Recorder> recorder(new Recorder(options));
  recorder->encoder_ = std::make_unique<Encoder>();
  if (!recorder->encoder_->writer.open(where, cv::CAP_FFMPEG,
                                       cv::VideoWriter::fourcc('a', 'v', 'c', '1'), options.rate,
                                       {options.width, options.height}))
    return Error{"no H.264 encoder", where, "install libavcodec59 and libx264-164",
                 Error::Kind::device};
  recorder->thread_ = std::thread([recorder = recorder.get()] { recorder->encode(); });
  return recorder;
}

Recorder::Recorder(const RecordingOptions& options) : options_(options) {}

Recorder::~Recorder() {
  if (thread_.joinable()) [[maybe_unused]]
    const auto unread = close();
}

Status Recorder::write(const cv::Mat& picture, Timestamp time) {
  if (picture.type() != CV_8UC3 || picture.cols != options_.width ||
      picture.rows != options_.height)
    return Error{"a picture of " + std::to_string(picture.cols) + "x" +
                     std::to_string(picture.rows) + " px in a recording of " +
                     std::to_string(options_.width) + "x" + std::to_string(options_.height),
                 options_.file.string(), "start a new recording after resizing"};
  std::unique_lock lock(mutex_);
  if (failure_) return *failure_;
  if (options_.pace == RecordingPace::live && waiting_.size() >= options_.queue) {
    ++dropped_;
    return ok();
  }
  changed_.wait(lock, [this] { return waiting_.size() < options_.queue || failure_; });
  if (failure_) return *failure_;
  waiting_.push_back(picture);
  times_.push_back(time);
  lock.unlock();
  changed_.notify_all();
  return ok();
}

void Recorder::encode() {
  for (;;) {
    cv::Mat picture;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !waiting_.empty() || closing_; });
      if (waiting_.empty() || failure_) return;
      picture = std::move(waiting_.front());
      waiting_.pop_front();
    }
    changed_.notify_all();
    if (written_ % kFramesBetweenChecks == 0 && !space_left(options_.file)) {
      fail(disk_full(options_.file));
      return;
    }
    encoder_->writer.write(picture);
    ++written_;
  }
}

void Recorder::fail(Error error) {
  {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(error);
    waiting_.clear();
  }
  changed_.notify_all();
}

Result<RecordingSummary> Recorder::close(const SoundTrack& sounds) {
  if (closed_) return *closed_;
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
  encoder_->writer.release();
  closed_ = finish(sounds);
  return *closed_;
}

// The encoder's library does not report failed writes: the file itself has to be asked.
Result<RecordingSummary> Recorder::finish(const SoundTrack& sounds) {
  if (failure_) return *failure_;
  std::int64_t frames = 0;
  if (written_ > 0) {
    const cv::VideoCapture file(options_.file.string(), cv::CAP_FFMPEG);
    frames = file.isOpened() ? std::llround(file.get(cv::CAP_PROP_FRAME_COUNT)) : 0;
  }
  if (frames != written_)
    return Error{"only " + std::to_string(frames) + " of " + std::to_string(written_) +
                     " frames reached the file",
                 options_.file.string(), "look whether the disk is full", Error::Kind::device};
  if (frames > 0) {
    if (const Status sounded = add_sound(options_.file, in_film_time(sounds)); !sounded)
      return sounded.error();
  }
  return RecordingSummary{frames, dropped_};
}

// Live, a film has fewer pictures than the source had frames, and runs faster: a sound starts with
// the picture nearest in time, or after the sound before it.
SoundTrack Recorder::in_film_time(const SoundTrack& sounds) const {
  SoundTrack track;
  Timestamp free = 0;
  for (const PlacedSound& placed : sounds) {
    auto picture = std::lower_bound(times_.begin(), times_.end(), placed.start);
    if (picture == times_.end() ||
        (picture != times_.begin() && placed.start - *(picture - 1) < *picture - placed.start))
      --picture;
    const double start = static_cast<double>(picture - times_.begin()) / options_.rate;
    track.push_back({std::max(free, timestamp_from_seconds(start)), placed.sound});
    free = track.back().start + timestamp_from_seconds(placed.sound->seconds());
  }
  return track;
}

Status write_png(const std::filesystem::path& file, const cv::Mat& picture) {
  std::vector<unsigned char> png;
  // Level 1 is three times as fast as the default and some ten per cent larger.
  if (!cv::imencode(".png", picture, png, {cv::IMWRITE_PNG_COMPRESSION, 1}))
    return Error{"the picture cannot be encoded as PNG", file.string(), "this is a defect"};
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  out.flush();
  if (out) return ok();
  return Error{std::string("cannot be written: ") + std::strerror(errno), file.string(),
               "name a file in an existing folder with space left that you may write to"};
}

}  // namespace armsreach::render
