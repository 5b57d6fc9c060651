#include "app/pipelines/journal.hpp"

#include <cstdio>

#include "vision/core/trajectory.hpp"

namespace armsreach::app {

std::optional<JournalEntry> entry_from_tracked(const TrackedFramePtr& tracked) {
  if (!tracked) return std::nullopt;
  JournalEntry entry;
  entry.time = tracked->frame->time;
  entry.arrival = tracked->frame->arrival;
  entry.world_from_camera = tracked->world_from_camera;
  entry.state = tracked->state;
  entry.pose_known = pose_known(*tracked) && tracked->pose_seen;
  entry.rms = tracked->rms;
  entry.inliers = tracked->inliers;
  return entry;
}

double Journal::rate() const {
  const double seconds = 1e-9 * static_cast<double>(last_arrival_ - first_arrival_);
  return seconds > 0 ? static_cast<double>(frames_ - 1) / seconds : 0;
}

std::string Journal::progress() const {
  char line[96];
  if (state_ == TrackingState::untracked) {
    std::snprintf(line, sizeof line, "%lld frames, %.1f Hz", static_cast<long long>(frames_),
                  rate());
    return line;
  }
  std::snprintf(line, sizeof line, "%lld frames, %lld tracked, %.1f Hz: %s",
                static_cast<long long>(frames_), static_cast<long long>(tracked_frames_), rate(),
                state_ ? std::string(name(*state_)).c_str() : "waiting");
  return line;
}

void Journal::record(const JournalEntry& entry) {
  if (frames_++ == 0) first_arrival_ = entry.arrival;
  last_arrival_ = entry.arrival;
  if (entry.pose_known) {
    ++tracked_frames_;
    if (file_.is_open()) write_tum_pose(file_.stream(), {entry.time, entry.world_from_camera});
  }
  if (state_ == entry.state) return;
  state_ = entry.state;
  if (entry.state == TrackingState::untracked) return;
  log_.write({entry.time, TrackingEvent{entry.state, entry.rms, entry.inliers}});
}

}  // namespace armsreach::app
