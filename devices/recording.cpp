#include "devices/recording.hpp"

#include <atomic>
#include <utility>

namespace armsreach {
namespace {

class Playback : public Source {
 public:
  Playback(std::unique_ptr<Recording> recording, Loop loop)
      : recording_(std::move(recording)), loop_(loop), size_(recording_->size()) {}

  const std::shared_ptr<const SensorInfo>& sensor() const override { return recording_->sensor(); }
  void stop() override { stopped_ = true; }
  Events take_events() override { return recording_->take_events(); }
  std::optional<std::int64_t> frame_count() const override {
    return loop_ == Loop::once ? recording_->size() : std::nullopt;
  }

  Result<FramePtr> next() override {
    if (stopped_) return FramePtr();
    const std::int64_t index = recorded_index();
    auto read = recording_->read(index);
    if (!read) {
      ++played_;
      return std::move(read).error();
    }
    if (!*read) {
      if (loop_ == Loop::once || index == 0) return FramePtr();
      size_ = index;  // now known; turn round here
      return next();
    }
    auto frame = std::make_shared<Frame>(std::move(**read));
    frame->index = played_;
    frame->time = played_time();
    ++played_;
    return FramePtr(std::move(frame));
  }

 private:
  bool turns() const { return loop_ == Loop::pingpong && size_; }
  std::int64_t period() const { return 2 * (*size_ - 1); }

  // 0 1 .. n-1 n-2 .. 1 0 1 ..: the ends are shown once a turn.
  std::int64_t recorded_index() const {
    if (!turns()) return played_;
    if (*size_ <= 1) return 0;
    const std::int64_t phase = played_ % period();
    return phase < *size_ ? phase : period() - phase;
  }

  Timestamp played_time() const {
    if (!turns() || played_ < *size_) return recording_->time(played_);
    const Timestamp first = recording_->time(0);
    if (*size_ <= 1) {
      return first +
             timestamp_from_seconds(static_cast<double>(played_) / recording_->sensor()->rate);
    }
    const Timestamp span = recording_->time(*size_ - 1) - first;
    const std::int64_t phase = played_ % period();
    const Timestamp since_first = recording_->time(recorded_index()) - first;
    return first + played_ / period() * 2 * span +
           (phase < *size_ ? since_first : 2 * span - since_first);
  }

  std::unique_ptr<Recording> recording_;
  Loop loop_;
  std::optional<std::int64_t> size_;
  std::int64_t played_ = 0;  // frames asked for so far, the broken ones too
  std::atomic<bool> stopped_ = false;
};

}  // namespace

Result<Loop> loop_option(const SourceSpec& spec) {
  const std::string text = option(spec, "loop").value_or("once");
  if (text == "once") return Loop::once;
  if (text == "pingpong") return Loop::pingpong;
  return Error{"option 'loop' is '" + text + "'", text_of(spec), "give loop=once or loop=pingpong"};
}

std::unique_ptr<Source> play(std::unique_ptr<Recording> recording, Loop loop) {
  return std::make_unique<Playback>(std::move(recording), loop);
}

}  // namespace armsreach
