#include "vision/alignment/tracker.hpp"

#include <utility>

namespace armsreach {
namespace {

bool sees_anything(const cv::Mat& depth) {
  std::size_t known = 0;
  for (int row = 0; row < depth.rows; ++row) {
    for (int col = 0; col < depth.cols; ++col) known += depth.at<float>(row, col) > 0 ? 1 : 0;
  }
  return 10 * known > depth.total();
}

}  // namespace

Tracker::Tracker(TrackerOptions options)
    : options_(std::move(options)),
      aligner_(options_.aligner),
      motion_(options_.motion),
      verdict_(options_.aligner.alpha) {}

TrackedFrame Tracker::reduced(const FramePtr& frame) {
  if (!reducer_) {
    reducer_.emplace(frame->sensor, options_.width);
    motion_.start(options_.start, frame->time);
  }
  ReducedFrame images = reducer_->reduce(*frame);
  TrackedFrame tracked;
  tracked.frame = frame;
  tracked.camera = reducer_->camera();
  tracked.depth = std::move(images.depth);
  tracked.intensity = std::move(images.intensity);
  camera_.assign(tracked.camera, tracked.depth, tracked.intensity,
                 static_cast<int>(options_.aligner.iterations.size()));
  return tracked;
}

TrackedFrame Tracker::track(const FramePtr& frame, const ReferenceViewPtr& map_reference) {
  TrackedFrame tracked = reduced(frame);
  take_map_reference(map_reference);
  if (own_.empty() && map_.empty()) {
    motion_.start(options_.start, frame->time);  // however long it took to see something
    tracked.world_from_camera = options_.start;
    if (sees_anything(tracked.depth)) keep_as_reference(tracked);
    return tracked;
  }
  Attempt best = best_attempt(frame->time);
  tracked.reference = best.reference;
  tracked.rms = verdict_.relative_rms(best.alignment);
  tracked.inliers = best.alignment.inliers;
  tracked.compared = best.alignment.compared;
  tracked.depth_noise = best.alignment.scales.depth;
  tracked.intensity_offset = best.alignment.intensity_offset;
  tracked.weights = std::move(best.alignment.weights);
  if (best.trusted) {
    tracked.state = TrackingState::tracking;
    tracked.world_from_camera = best.world_from_camera;
    motion_.update(best.world_from_camera, frame->time);
    verdict_.learn(best.alignment);
    intensity_offset_ = best.alignment.intensity_offset;
    keep_as_reference(tracked);
  } else {
    tracked.state = TrackingState::lost;
    tracked.world_from_camera = motion_.predicted(frame->time);
    motion_.coast(frame->time);
  }
  return tracked;
}

void Tracker::take_map_reference(const ReferenceViewPtr& view) {
  if (view == map_view_) return;
  map_view_ = view;
  if (!view) {
    map_ = {};
    return;
  }
  map_.pyramid.assign(view->camera, view->depth, view->intensity, camera_.size());
  map_.world_from_camera = view->world_from_reference;
  map_.frame = view->frame;
}

// The map before the tracker's own frame, where the camera is predicted before where it was seen
// last; the first that is trusted, else the first.
Tracker::Attempt Tracker::best_attempt(Timestamp time) {
  std::optional<Attempt> first;
  for (const Reference* reference : {&map_, &own_}) {
    if (reference->empty()) continue;
    for (const Pose& start : {motion_.predicted(time), motion_.measured()}) {
      Attempt tried = attempt(*reference, start, time);
      if (tried.trusted) return tried;
      if (!first) first = std::move(tried);
    }
  }
  return std::move(*first);
}

Tracker::Attempt Tracker::attempt(const Reference& reference, const Pose& start, Timestamp time) {
  Attempt out;
  out.alignment = aligner_.align(camera_, reference.pyramid,
                                 reference.world_from_camera.inverse() * start, intensity_offset_);
  out.world_from_camera = reference.world_from_camera * out.alignment.reference_from_camera;
  out.reference = reference.frame;
  out.trusted = verdict_.trusts(out.alignment, camera_[0].width() * camera_[0].height()) &&
                motion_.plausible(out.world_from_camera, time);
  return out;
}

void Tracker::keep_as_reference(const TrackedFrame& tracked) {
  const bool still_good =
      options_.own_reference == OwnReference::key_frame && !own_.empty() &&
      tracked.inliers > options_.key_frame_inliers * static_cast<double>(tracked.weights.total());
  if (still_good || tracked.depth.empty()) return;
  std::swap(own_.pyramid, camera_);
  own_.world_from_camera = tracked.world_from_camera;
  own_.frame = tracked.frame->index;
}

}  // namespace armsreach
