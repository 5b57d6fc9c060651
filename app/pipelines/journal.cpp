#include "app/pipelines/journal.hpp"

#include "vision/core/trajectory.hpp"

namespace armsreach::app {

void Journal::record(const TrackedFrame& tracked) {
  ++frames_;
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
