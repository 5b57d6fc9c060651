// Reads one sensor of a rig frame by frame: as fast as the stages take them, or, live, when a
// recording's own time says so.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "app/runtime/event_log.hpp"
#include "app/runtime/stage.hpp"
#include "app/runtime/wiring.hpp"
#include "devices/rig.hpp"

namespace armsreach::app {

class CaptureNode final : public Node {
 public:
  struct Options {
    std::string sensor = "main";  // frames of others are passed over
    Pace pace = Pace::live;
    std::optional<std::int64_t> frames;  // stop after so many
  };

  CaptureNode(Rig& rig, const Options& options, EventLog& log);

  Outlet<FramePtr>& outlet() { return outlet_; }
  // What is to be done once before every frame is read. Set before the run.
  void before_reading(std::function<void()> action) { before_reading_ = std::move(action); }
  bool turn() override;
  void stop();  // from any thread: the frames already read still go through

  // Why the source ended early, if it did.
  const std::optional<Error>& failure() const { return failure_; }

 private:
  FramePtr next_frame();
  void report_source_events();
  void wait_until_due(Timestamp time);

  Rig& rig_;
  Options options_;
  EventLog& log_;
  Outlet<FramePtr> outlet_;
  std::function<void()> before_reading_;
  std::optional<Error> failure_;
  std::optional<Error> broken_;  // the last
  std::int64_t delivered_ = 0;
  int broken_in_a_row_ = 0;

  // Live pace of a recording: wall time of source time zero.
  std::optional<std::chrono::steady_clock::time_point> zero_;
  std::mutex mutex_;
  std::condition_variable stopped_changed_;
  bool stopped_ = false;
};

}  // namespace armsreach::app
