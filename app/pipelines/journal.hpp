// Writes down every tracked frame: the trajectory file, and an event whenever the state changes.
#pragma once

#include <fstream>
#include <optional>
#include <string>

#include "app/runtime/event_log.hpp"
#include "vision/core/result.hpp"
#include "vision/core/tracked_frame.hpp"

namespace armsreach::app {

class Journal {
 public:
  explicit Journal(EventLog& log) : log_(log) {}

  Status open(const std::string& trajectory_path);  // "" writes no file
  void record(const TrackedFrame& tracked);
  Status close();

  std::int64_t frames() const { return frames_; }
  std::int64_t tracked_frames() const { return tracked_frames_; }

 private:
  EventLog& log_;
  std::string path_;
  std::ofstream file_;
  std::optional<TrackingState> state_;
  std::int64_t frames_ = 0;
  std::int64_t tracked_frames_ = 0;
};

}  // namespace armsreach::app
