// A frame and the pose that was found for it, with the reduced images the pose was computed from,
// so that mapping, segmentation and display neither repeat the work nor disagree about it.
#pragma once

#include <cstdint>
#include <memory>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/event.hpp"
#include "vision/core/frame.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/world_view.hpp"

namespace armsreach {

namespace mono_slam {
struct MonoResult;  // vision/mono_slam/mono_slam.hpp
}

// While initialising there is nothing to align against yet and the pose is the start pose, true by
// definition. A lost frame's pose is only a prediction.
struct TrackedFrame {
  FramePtr frame;
  Pose world_from_camera;
  TrackingState state = TrackingState::initialising;
  // A frame may show too little to say where the camera is before it counts as lost: its pose
  // follows from the frames before, good enough to draw by, but nothing that was measured.
  bool pose_seen = true;

  // Quality of the alignment; zero where there was none.
  double rms = 0;               // of the weighted residuals, each divided by its nominal noise
  int inliers = 0;              // compared pixels with a weight above zero
  int compared = 0;             // pixels of this frame that the reference could be compared with
  double depth_noise = 0;       // 1/m: robust deviation of (depth - reference depth) / depth^2
  double intensity_offset = 0;  // this frame's intensity minus the reference's
  std::int64_t reference = -1;  // index of the last frame in the view it was aligned against

  // Reduced images, all of `camera`'s size and in the frame of world_from_camera.
  Camera camera;      // pinhole, no distortion
  cv::Mat depth;      // CV_32F metres along z, NaN unknown; empty when there is (almost) none
  cv::Mat intensity;  // CV_32F 0..1, NaN where the colour camera did not see; empty without colour
  // CV_32F Tukey weight of each pixel: 1 fits the reference, 0 does not, NaN was not compared (no
  // depth here, or nothing known there). Empty where there was no alignment.
  cv::Mat weights;

  // Of a frame that was tracked by its picture alone: what the filter knows, in pixels of `camera`,
  // which is then the picture's, reduced, with its distortion, and in no need of `depth` and the
  // rest; and its map. Null of others.
  std::shared_ptr<const mono_slam::MonoResult> mono;
  WorldViewPtr world;
  Eigen::Vector3d up_in_world{0, 0, 0};  // against gravity; zero where nobody knows
};
using TrackedFramePtr = std::shared_ptr<const TrackedFrame>;

// Whether the pose may carry new surface into a map.
inline bool trusted(const TrackedFrame& tracked) {
  return tracked.state == TrackingState::initialising || tracked.state == TrackingState::tracking;
}

// Whether the pose says where the camera is: not while it is lost, nor before it has seen anything.
inline bool pose_known(const TrackedFrame& tracked) {
  if (tracked.state == TrackingState::initialising) return !tracked.depth.empty();
  return tracked.state != TrackingState::lost && tracked.state != TrackingState::untracked;
}

}  // namespace armsreach
