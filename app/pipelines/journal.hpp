// Writes down every tracked frame: the trajectory file, and an event whenever the state changes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/runtime/event_log.hpp"
#include "app/runtime/output_file.hpp"
#include "vision/core/result.hpp"
#include "vision/core/tracked_frame.hpp"

namespace armsreach::app {

// What is written down of a tracked frame; small, so that many may wait for a drawing that stalls.
struct JournalEntry {
  Timestamp time = 0;
  std::int64_t arrival = 0;  // steady-clock ns
  Pose world_from_camera;
  TrackingState state = TrackingState::lost;
  bool pose_known = false;  // and seen in this frame
  double rms = 0;
  int inliers = 0;
};
// Nothing of a frame on which the tracker failed: it has said so.
std::optional<JournalEntry> entry_from_tracked(const TrackedFramePtr& tracked);

class Journal {
 public:
  explicit Journal(EventLog& log) : log_(log) {}

  // "" writes no file.
  Status open(const std::string& trajectory_path) { return file_.open(trajectory_path); }
  void record(const JournalEntry& entry);
  Status close() { return file_.close(); }

  // Frames a second between the arrivals of the first and the last; 0 with fewer than two.
  double rate() const;
  std::int64_t frames() const { return frames_; }
  std::int64_t tracked_frames() const { return tracked_frames_; }
  std::string progress() const;  // the same in words

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
