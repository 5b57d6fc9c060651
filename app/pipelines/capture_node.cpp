#include "app/pipelines/capture_node.hpp"

#include <utility>

namespace armsreach::app {
namespace {

// A recording with a few broken frames is played around them; a source that gives nothing else has
// failed.
constexpr int kMostBrokenInARow = 30;

}  // namespace

CaptureNode::CaptureNode(Rig& rig, const Options& options, EventLog& log)
    : Node("capture",
           [this, &log](const std::string& stage, const std::string& what) {
             log.write({log_.now(), FaultEvent{stage, what, "see the source's own messages"}});
           }),
      rig_(rig),
      options_(options),
      log_(log) {}

bool CaptureNode::turn() {
  if (before_reading_) before_reading_();
  FramePtr frame = next_frame();
  if (!frame) {
    outlet_.close();
    return false;
  }
  if (options_.pace == Pace::live && !rig_.live()) wait_until_due(frame->time);
  auto stamped = std::make_shared<Frame>(*frame);
  stamped->arrival = std::chrono::steady_clock::now().time_since_epoch().count();
  log_.set_now(frame->time);
  ++delivered_;
  outlet_.push(std::move(stamped));
  return true;
}

// Null at the end: of the recording, of the frames asked for, or after stop().
FramePtr CaptureNode::next_frame() {
  while (!options_.frames || delivered_ < *options_.frames) {
    {
      const std::lock_guard lock(mutex_);
      if (stopped_) return nullptr;
    }
    std::optional<Result<FramePtr>> result;
    const auto start = std::chrono::steady_clock::now();
    const bool good = reported([&] { result = rig_.next(); });
    report_source_events();
    if (good && result->ok()) {
      broken_in_a_row_ = 0;
      const FramePtr& frame = **result;
      if (frame) count_frame(start);
      // Played to its end without one good frame.
      if (!frame && delivered_ == 0) failure_ = std::exchange(broken_, std::nullopt);
      if (frame && frame->sensor->name != options_.sensor) continue;
      return frame;
    }
    if (good) {
      const Error& error = result->error();
      log_.write(
          {log_.now(), FaultEvent{"capture", error.where + ": " + error.what, error.remedy}});
      if (error.kind == Error::Kind::away) continue;
      if (error.kind == Error::Kind::device || ++broken_in_a_row_ >= kMostBrokenInARow) {
        failure_ = error;
        return nullptr;
      }
      broken_ = error;
    } else if (++broken_in_a_row_ >= kMostBrokenInARow) {
      failure_ =
          Error{"the source keeps failing", "capture", "see the events", Error::Kind::device};
      return nullptr;
    }
  }
  return nullptr;
}

void CaptureNode::report_source_events() {
  // Devices know only their own clock.
  for (const Event& event : rig_.take_events()) log_.write({log_.now(), event.body});
}

void CaptureNode::wait_until_due(Timestamp time) {
  const auto since_zero = std::chrono::nanoseconds(time);
  if (!zero_) zero_ = std::chrono::steady_clock::now() - since_zero;
  std::unique_lock lock(mutex_);
  stopped_changed_.wait_until(lock, *zero_ + since_zero, [this] { return stopped_; });
}

void CaptureNode::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  stopped_changed_.notify_all();
  rig_.stop();
}

}  // namespace armsreach::app
