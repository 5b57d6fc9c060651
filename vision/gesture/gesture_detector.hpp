// Hands and their gestures in a mask of skin.
#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/gesture/hand_observation.hpp"
#include "vision/gesture/hand_shape.hpp"
#include "vision/gesture/ring_matcher.hpp"

namespace armsreach::gesture {

struct GestureDetectorOptions {
  HandFinderOptions hands;
  Hands templates = Hands::both;
  double least_score = 0.7;    // g of a gesture that is told [paper: tau]
  double least_margin = 0.02;  // by which it exceeds every other's
};

// How far a hand that is straight on its forearm is turned from upright, rad clockwise; nothing
// where no forearm was seen.
std::optional<double> straight_angle(const HandShape& shape);

// What a hand's shape gives when sampled by rings turned by `turn`.
RingSignature signature_of(const HandShape& shape, const RingLayout& layout, double turn = 0);

// A gesture learnt from one example: turned so that its forearm points down, where it has one.
GestureTemplate template_of(const std::string& gesture, const HandShape& shape,
                            const RingLayout& layout);

class GestureDetector {
 public:
  explicit GestureDetector(TemplateSet set, const GestureDetectorOptions& options = {});

  const RingMatcher& matcher() const { return matcher_; }
  // `skin`: CV_8UC1, 0 off the skin.
  HandObservations detect(const cv::Mat& skin) const;

 private:
  HandObservation observe(const HandBlob& blob) const;

  GestureDetectorOptions options_;
  HandFinder finder_;
  RingMatcher matcher_;
};

}  // namespace armsreach::gesture
