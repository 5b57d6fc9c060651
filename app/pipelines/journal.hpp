// Writes down every tracked frame: the trajectory file, and an event whenever the state changes.
#pragma once

#include <optional>
#include <string>

#include "app/runtime/event_log.hpp"
#include "app/runtime/output_file.hpp"
#include "vision/core/result.hpp"
#include "vision/core/tracked_frame.hpp"

namespace armsreach::app {

class Journal {
 public:
  explicit Journal(EventLog& log) : log_(log) {}

  // "" writes no file.
  Status open(const std::string& trajectory_path) { return file_.open(trajectory_path); }
  void record(const TrackedFrame& tracked);
  Status close() { return file_.close(); }

  // Frames a second between the arrivals of the first and the last; 0 with fewer than two.
  double rate() const;
  std::int64_t frames() const { return frames_; }
  std::int64_t tracked_frames() const { return tracked_frames_; }

 private:
  EventLog& log_;
  OutputFile file_;
  std::optional<TrackingState> state_;
  std::int64_t first_arrival_ = 0;
  std::int64_t last_arrival_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t tracked_frames_ = 0;
};

}  // namespace armsreach::app
