// Finds the camera's pose frame by frame: a motion model, the aligner, a reference to align against
// and an honest opinion of the outcome.
#pragma once

#include <cstdint>
#include <optional>

#include "vision/alignment/aligner.hpp"
#include "vision/alignment/frame_reducer.hpp"
#include "vision/alignment/motion_model.hpp"
#include "vision/alignment/verdict.hpp"
#include "vision/core/frame.hpp"
#include "vision/core/reference_view.hpp"
#include "vision/core/tracked_frame.hpp"

namespace armsreach {

// What a frame is aligned against while there is no view of a map.
enum class OwnReference {
  previous_frame,  // drifts with every step
  key_frame,       // a frame that is kept until too little of it is seen
};

struct TrackerOptions {
  AlignerOptions aligner;
  int width = 80;  // of the finest level, pixels
  OwnReference own_reference = OwnReference::previous_frame;
  // A new key frame is taken when fewer inliers are left than this fraction of what the old one had
  // at first.
  double key_frame_inliers = 0.85;
  MotionOptions motion;
  Pose start;  // world_from_camera of the first frame
};

class Tracker {
 public:
  explicit Tracker(TrackerOptions options = {});

  // `map_reference` may be null, may have been drawn some frames ago, and may be given again.
  // Frames come in the order of their times, from one sensor.
  TrackedFrame track(const FramePtr& frame, const ReferenceViewPtr& map_reference);

 private:
  // An image pair with a known pose.
  struct Reference {
    Pyramid pyramid;
    Pose world_from_camera;
    std::int64_t frame = -1;
    int inliers_at_first = 0;  // of the first frame that was aligned against it
    bool empty() const { return pyramid.size() == 0; }
  };
  struct Attempt {
    AlignmentResult alignment;
    Pose world_from_camera;
    const Reference* reference = nullptr;
    bool trusted = false;
  };

  TrackedFrame reduced(const FramePtr& frame);
  void take_map_reference(const ReferenceViewPtr& view);
  Attempt best_attempt(Timestamp time);
  Attempt attempt(const Reference& reference, const Pose& start, Timestamp time);
  // Takes the frame over as own reference, unless the key frame `used` is still good.
  void keep_as_reference(const TrackedFrame& tracked, const Reference* used);

  TrackerOptions options_;
  Aligner aligner_;
  MotionModel motion_;
  Verdict verdict_;
  std::optional<FrameReducer> reducer_;
  Pyramid camera_;  // of the frame being tracked
  Reference own_;
  Reference map_;
  ReferenceViewPtr map_view_;  // that map_ was made from
  double intensity_offset_ = 0;
};

}  // namespace armsreach
