#include "app/pipelines/journal.hpp"

#include "vision/core/trajectory.hpp"

namespace armsreach::app {

Status Journal::open(const std::string& trajectory_path) {
  path_ = trajectory_path;
  if (path_.empty()) return ok();
  file_.open(path_);
  if (!file_) return Error{"cannot be written", path_, "check that its folder exists and is yours"};
  return ok();
}

void Journal::record(const TrackedFrame& tracked) {
  ++frames_;
  if (trusted(tracked)) {
    ++tracked_frames_;
    if (file_.is_open()) write_tum_pose(file_, {tracked.frame->time, tracked.world_from_camera});
  }
  if (state_ == tracked.state) return;
  state_ = tracked.state;
  log_.write({tracked.frame->time, TrackingEvent{tracked.state, tracked.rms, tracked.inliers}});
}

Status Journal::close() {
  if (!file_.is_open()) return ok();
  file_.close();
  if (!file_) {
    return Error{"could not be written completely", path_, "is the disk full?",
                 Error::Kind::device};
  }
  return ok();
}

}  // namespace armsreach::app
