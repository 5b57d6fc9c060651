#include "app/pipelines/journal.hpp"

#include "vision/core/trajectory.hpp"

namespace armsreach::app {

double Journal::rate() const {
  const double seconds = 1e-9 * static_cast<double>(last_arrival_ - first_arrival_);
  return seconds > 0 ? static_cast<double>(frames_ - 1) / seconds : 0;
}

void Journal::record(const TrackedFrame& tracked) {
  if (frames_++ == 0) first_arrival_ = tracked.frame->arrival;
  last_arrival_ = tracked.frame->arrival;
  if (trusted(tracked)) {
    ++tracked_frames_;
    if (file_.is_open())
      write_tum_pose(file_.stream(), {tracked.frame->time, tracked.world_from_camera});
  }
  if (state_ == tracked.state) return;
  state_ = tracked.state;
  log_.write({tracked.frame->time, TrackingEvent{tracked.state, tracked.rms, tracked.inliers}});
}

}  // namespace armsreach::app
