// Records pictures to an H.264 mp4 on a thread of its own, with what was said meanwhile as its
// sound track, and single pictures to PNG.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/result.hpp"
#include "vision/core/sound.hpp"

namespace armsreach::render {

enum class RecordingPace {
  every_frame,  // write() waits while the queue is full: nothing is dropped
  live,         // write() drops the picture while the queue is full, and counts it
};

struct RecordingOptions {
  std::filesystem::path file;  // ends in .mp4
  int width = 0;               // px, even: H.264 halves the colours' resolution
  int height = 0;
  double rate = 30;  // Hz
  RecordingPace pace = RecordingPace::every_frame;
  std::size_t queue = 8;  // pictures waiting at most
};

struct RecordingSummary {
  std::int64_t frames = 0;  // in the file
  std::int64_t dropped = 0;
};

class Recorder {
 public:
  // Errors: a wrong name or size, a folder that is missing or cannot be written to.
  static Result<std::unique_ptr<Recorder>> open(const RecordingOptions& options);
  ~Recorder();  // finishes the file

  // CV_8UC3 BGR of the stated size, not written to afterwards. Once recording has failed (the disk
  // is full), returns why. `time` is the picture's source time, for sounds to find it.
  Status write(const cv::Mat& picture, Timestamp time = 0);
  std::int64_t dropped() const { return dropped_; }

  // Encodes what waits, finishes the file and looks whether it holds every frame. The sounds are
  // heard with the pictures of their source time, wherever in the film those are; without any the
  // film has no sound track. A second call returns what the first did.
  Result<RecordingSummary> close(const SoundTrack& sounds = {});

 private:
  struct Encoder;

  explicit Recorder(const RecordingOptions& options);
  void encode();
  void fail(Error error);
  Result<RecordingSummary> finish(const SoundTrack& sounds);
  SoundTrack in_film_time(const SoundTrack& sounds) const;

  RecordingOptions options_;
  std::unique_ptr<Encoder> encoder_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<cv::Mat> waiting_;
  std::vector<Timestamp> times_;  // of the pictures taken in
  bool closing_ = false;
  std::optional<Error> failure_;
  std::atomic<std::int64_t> dropped_ = 0;
  std::int64_t written_ = 0;  // the encoder thread's until it has ended
  std::optional<Result<RecordingSummary>> closed_;
  std::thread thread_;
};

// CV_8UC3 BGR, CV_8UC1 or CV_16UC1.
Status write_png(const std::filesystem::path& file, const cv::Mat& picture);

}  // namespace armsreach::render
