#include "vision/alignment/tracker.hpp"

#include <algorithm>
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

AlignerOptions usual(const TrackerOptions& options) {
  AlignerOptions aligner = options.aligner;
  if (aligner.iterations.empty()) aligner.iterations = default_iterations(options.width);
  return aligner;
}

// Where nothing else says where the camera is, the picture has half a say: depth alone slides along
// walls and counters (redkitchen covered for a second: 5 to 15 cm off where a third of the view was
// known, 0.5 to 2.5 cm with the picture).
constexpr double kSearchingAlpha = 0.5;
// Nor does it change at once: what is known of the view has to grow first.
constexpr Timestamp kSearchingOn = 500'000'000;  // ns

// Coarser by one level, and with iterations enough to come from farther away.
AlignerOptions searching_options(AlignerOptions options) {
  if (options.alpha < 1) options.alpha = std::min(options.alpha, kSearchingAlpha);
  for (int& iterations : options.iterations) iterations = std::max(iterations, 10);
  options.iterations.push_back(20);
  return options;
}

}  // namespace

std::vector<int> default_iterations(int width) {
  if (width < 120) return {5, 3};
  std::vector<int> iterations{3, 4};
  for (; width >= 240; width /= 2) iterations.push_back(4);
  iterations.push_back(3);
  return iterations;
}

Tracker::Tracker(TrackerOptions options)
    : options_(std::move(options)),
      aligner_(usual(options_)),
      searching_aligner_(searching_options(aligner_.options())),
      motion_(options_.motion) {}

TrackedFrame Tracker::reduced(const FramePtr& frame) {
  if (!reducer_) motion_.start(options_.start.value_or(Pose()), frame->time);
  if (sensor_ != frame->sensor) {
    sensor_ = frame->sensor;
    reducer_.emplace(sensor_, options_.width);
  }
  sensor_noise_.learn(frame->depth);
  ReducedFrame images = reducer_->reduce(*frame, sensor_noise_.k());
  TrackedFrame tracked;
  tracked.frame = frame;
  tracked.camera = reducer_->camera();
  if (sees_anything(images.depth)) tracked.depth = std::move(images.depth);
  tracked.intensity = std::move(images.intensity);
  camera_.assign(tracked.camera, tracked.depth, tracked.intensity,
                 static_cast<int>(searching_aligner_.options().iterations.size()));
  return tracked;
}

TrackedFrame Tracker::track(const FramePtr& frame, const ReferenceViewPtr& map_reference,
                            const ReferenceViewPtr& proposed) {
  TrackedFrame tracked = reduced(frame);
  take(map_reference, map_view_, map_);
  const bool unknown_world = own_.empty() && map_.empty();
  if (unknown_world && options_.start) {
    motion_.start(*options_.start, frame->time);  // however long it took to see something
    tracked.world_from_camera = *options_.start;
    keep_as_reference(tracked, nullptr);
    return tracked;
  }
  if (!unknown_world) {
    Attempt best = best_attempt(frame->time);
    report(best, tracked);
    if (best.trusted) {
      if (!motion_.recent(frame->time)) search_until_ = frame->time + kSearchingOn;
      tracked.state = TrackingState::tracking;
      motion_.update(best.world_from_camera, frame->time);
      verdict_.learn(best.alignment);
      keep_as_reference(tracked, best.reference);
      return tracked;
    }
  }
  if (proposed && relocalise(proposed, tracked)) return tracked;
  tracked.state = TrackingState::lost;
  tracked.world_from_camera = motion_.predicted(frame->time);
  motion_.coast(frame->time);
  return tracked;
}

void Tracker::report(Attempt& attempt, TrackedFrame& tracked) {
  tracked.world_from_camera = attempt.world_from_camera;
  tracked.reference = attempt.reference->frame;
  tracked.rms = verdict_.relative_rms(attempt.alignment);
  tracked.inliers = attempt.alignment.inliers;
  tracked.compared = attempt.alignment.compared;
  tracked.depth_noise = attempt.alignment.scales.depth;
  tracked.intensity_offset = attempt.alignment.intensity_offset;
  tracked.weights = std::move(attempt.alignment.weights);
  if (attempt.trusted) intensity_offset_ = attempt.alignment.intensity_offset;
}

void Tracker::take(const ReferenceViewPtr& view, ReferenceViewPtr& taken,
                   Reference& reference) const {
  if (view == taken) return;
  taken = view;
  if (!view || !sees_anything(view->depth)) {
    reference = {};
    return;
  }
  reference.pyramid.assign(view->camera, view->depth, view->intensity, camera_.size());
  reference.world_from_camera = view->world_from_reference;
  reference.frame = view->frame;
}

bool Tracker::relocalise(const ReferenceViewPtr& proposed, TrackedFrame& tracked) {
  take(proposed, proposed_view_, proposed_);
  Attempt found;
  // From where the view was drawn, and, should the camera have stayed, from where it was last.
  for (const Pose& start : {proposed_.world_from_camera, motion_.measured()}) {
    found = attempt(searching_aligner_, proposed_, start);
    found.trusted = verdict_.confirms(found.alignment, pixels());
    if (found.trusted) break;
  }
  if (!found.trusted) return false;
  report(found, tracked);
  tracked.state = TrackingState::relocalised;
  motion_.start(tracked.world_from_camera, tracked.frame->time);
  search_until_ = tracked.frame->time + kSearchingOn;
  std::swap(map_, proposed_);
  proposed_view_ = nullptr;
  own_ = {};
  keep_as_reference(tracked, nullptr);
  return true;
}

// The map before the tracker's own frame, where the camera is predicted before where it was seen
// last; then the same from farther away. The first that is trusted, else the first.
Tracker::Attempt Tracker::best_attempt(Timestamp time) {
  std::optional<Attempt> first;
  for (Aligner* aligner : {&aligner_, &searching_aligner_}) {
    if (aligner == &aligner_ && searching(time)) continue;
    for (const Reference* reference : {&map_, &own_}) {
      if (reference->empty()) continue;
      for (const Pose& start : {motion_.predicted(time), motion_.measured()}) {
        Attempt tried = attempt(*aligner, *reference, start);
        tried.trusted = follows(tried, time);
        if (tried.trusted) return tried;
        if (!first) first = std::move(tried);
      }
    }
  }
  return std::move(*first);
}

bool Tracker::follows(const Attempt& tried, Timestamp time) const {
  // Who has not been seen for a while may be anywhere: then the fit alone must convince.
  const bool fits = motion_.recent(time) ? verdict_.trusts(tried.alignment, pixels())
                                         : verdict_.confirms(tried.alignment, pixels());
  return fits && motion_.plausible(tried.world_from_camera, time);
}

Tracker::Attempt Tracker::attempt(Aligner& aligner, const Reference& reference,
                                  const Pose& start) const {
  Attempt out;
  out.alignment = aligner.align(camera_, reference.pyramid,
                                reference.world_from_camera.inverse() * start, intensity_offset_);
  out.world_from_camera = reference.world_from_camera * out.alignment.reference_from_camera;
  out.reference = &reference;
  return out;
}

void Tracker::keep_as_reference(const TrackedFrame& tracked, const Reference* used) {
  if (tracked.depth.empty()) return;
  if (options_.own_reference == OwnReference::key_frame && used == &own_) {
    if (own_.inliers_at_first == 0) own_.inliers_at_first = tracked.inliers;
    if (tracked.inliers > options_.key_frame_inliers * own_.inliers_at_first) return;
  }
  std::swap(own_.pyramid, camera_);
  own_.world_from_camera = tracked.world_from_camera;
  own_.frame = tracked.frame->index;
  own_.inliers_at_first = 0;
}

}  // namespace armsreach
