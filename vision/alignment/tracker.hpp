// Finds the camera's pose frame by frame: a motion model, the aligner, a reference to align against
// and an honest opinion of the outcome.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vision/alignment/aligner.hpp"
#include "vision/alignment/frame_reducer.hpp"
#include "vision/alignment/motion_model.hpp"
#include "vision/alignment/sensor_noise.hpp"
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

// Iterations from the finest level, of this width [px], to one of about 40 pixels. The finest ones
// cost most and, once the coarser have come near, need few.
std::vector<int> default_iterations(int width);

struct TrackerOptions {
  AlignerOptions aligner{.iterations = {}};  // none: the default ones of the width
  int width = 80;                            // of the finest level, pixels
  OwnReference own_reference = OwnReference::previous_frame;
  // A new key frame is taken when fewer inliers are left than this fraction of what the old one had
  // at first.
  double key_frame_inliers = 0.85;
  MotionOptions motion;
  // world_from_camera of the first frame. Nothing: the world is a map that exists already, and the
  // camera is lost until it is found in it.
  std::optional<Pose> start = Pose();
};

class Tracker {
 public:
  explicit Tracker(TrackerOptions options = {});

  // `map_reference` may be null, may have been drawn some frames ago, and may be given again.
  // Frames come in the order of their times, from one sensor; its colour camera may become known
  // on the way.
  //
  // `proposed` is a view of the map from where a relocaliser believes the camera to be, or to have
  // been some frames ago. A camera that is lost is aligned against it from its pose, wherever that
  // is, and must fit closely; a frame that does is `relocalised`, and tracking goes on from there
  // against that view until `map_reference` is another one than now. It may be null, may be given
  // again, and says nothing to a camera that is not lost.
  TrackedFrame track(const FramePtr& frame, const ReferenceViewPtr& map_reference,
                     const ReferenceViewPtr& proposed = nullptr);

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

  int pixels() const { return camera_[0].width() * camera_[0].height(); }
  TrackedFrame reduced(const FramePtr& frame);
  // Makes a reference of a view, unless it was made of `taken`, the one before.
  void take(const ReferenceViewPtr& view, ReferenceViewPtr& taken, Reference& reference) const;
  Attempt best_attempt(Timestamp time);
  // Lost, or found again just now.
  bool searching(Timestamp time) const { return !motion_.recent(time) || time < search_until_; }
  bool follows(const Attempt& tried, Timestamp time) const;
  Attempt attempt(Aligner& aligner, const Reference& reference, const Pose& start) const;
  // Tries the proposed view; when it fits, the world as it was known is given up for it.
  bool relocalise(const ReferenceViewPtr& proposed, TrackedFrame& tracked);
  void report(Attempt& attempt, TrackedFrame& tracked);
  // Takes the frame over as own reference, unless the key frame `used` is still good.
  void keep_as_reference(const TrackedFrame& tracked, const Reference* used);

  TrackerOptions options_;
  Aligner aligner_;
  Aligner searching_aligner_;  // from farther away, at leisure
  MotionModel motion_;
  Verdict verdict_;
  SensorNoise sensor_noise_;
  std::shared_ptr<const SensorInfo> sensor_;
  std::optional<FrameReducer> reducer_;
  Pyramid camera_;  // of the frame being tracked
  Reference own_;
  Reference map_;
  Reference proposed_;
  ReferenceViewPtr map_view_;       // given last; map_ was made from it, or proposed since
  ReferenceViewPtr proposed_view_;  // that proposed_ was made from
  Timestamp search_until_ = 0;
  double intensity_offset_ = 0;
};

}  // namespace armsreach
