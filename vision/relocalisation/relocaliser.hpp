// Where am I? Frames that were tracked are kept as key frames; a frame whose pose is unknown is
// recognised among them and given a pose.
//
// All key frames are ranked by a glance at the query's strongest features; with the best the query
// is matched in full, a three-point pose is found, checked against the depth of both, and refined
// over what all of them say should be seen.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "vision/core/frame.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/tracked_frame.hpp"
#include "vision/relocalisation/view.hpp"

namespace armsreach::relocalisation {

struct RelocaliserOptions {
  // A frame is kept when none is nearer than both.
  double key_distance = 0.15;  // m
  double key_angle = 0.14;     // rad
  int most_key_frames = 200;   // 90 kB each; beyond, one of the closest two is dropped
  int most_features = 500;     // a frame

  double match_ratio = 0.8;        // Lowe's, of distances
  std::size_t most_glanced = 150;  // of a query's features, to rank the key frames
  int most_tried = 6;              // key frames of the best ranks, for which a pose is sought
  double pixel_tolerance = 2.5;    // of the image the features are found in
  std::uint64_t seed = 1;

  // What a candidate must have. Frames of one recording asked of another's map reach 6 inliers.
  int least_inliers = 10;
  int least_inliers_without_depth = 15;
  double least_agreement = 0.75;  // share of the surface in both views that agrees
};

struct KeyFrame {
  std::int64_t frame = 0;  // index
  Pose world_from_color;
  View view;  // all its features have depth
};
using KeyFrames = std::vector<std::shared_ptr<const KeyFrame>>;

// A guess, to be confirmed by aligning the frame against the map.
struct Candidate {
  Pose world_from_camera;      // as everywhere: the depth camera's where there is one
  std::int64_t key_frame = 0;  // index of the frame it was recognised by
  int inliers = 0;             // matches with that frame which agree on the pose
  double agreement = 0;        // share of the surface in both views; 0 for a frame without depth
  double confidence = 0;       // 0..1: grows with inliers and agreement; not a probability
};

class Relocaliser {
 public:
  explicit Relocaliser(const RelocaliserOptions& options);

  // Keeps the frame if it is trusted, has colour and depth, and is far enough from those kept.
  // Costs next to nothing when it is not kept, else as much as finding features (20 ms).
  void consider(const TrackedFrame& tracked);

  // A frame without depth can be recognised, one without colour cannot. The same frame and key
  // frames give the same answer, whatever was asked before.
  std::optional<Candidate> relocalise(const Frame& frame) const;

  const RelocaliserOptions& options() const { return options_; }
  const KeyFrames& key_frames() const { return key_frames_; }
  // Keeps a key frame whatever its distance, as one read from a file.
  void put(std::shared_ptr<const KeyFrame> key_frame);

 private:
  RelocaliserOptions options_;
  KeyFrames key_frames_;  // oldest first
};

}  // namespace armsreach::relocalisation
