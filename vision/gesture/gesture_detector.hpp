// Hands and their gestures in a mask of skin.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/gesture/hand_evidence.hpp"
#include "vision/gesture/hand_observation.hpp"
#include "vision/gesture/hand_shape.hpp"
#include "vision/gesture/hand_texture.hpp"
#include "vision/gesture/ring_matcher.hpp"

namespace armsreach::gesture {

struct GestureDetectorOptions {
  HandFinderOptions hands;
  Hands templates = Hands::both;
  // How like a gesture a hand is: the mean g of its five nearest templates, which a bank of many
  // people's has; or g of the nearest alone.
  bool several_nearest = false;
  // Where the wrist is cut, and so the hand's area, is uncertain: rings are tried at these sizes.
  std::vector<double> sizes{1.0};
  double least_score = 0.85;   // g of a gesture that is told (the paper's tau is 0.7)
  double least_margin = 0.01;  // by which its likeness exceeds every other gesture's
  // Of hand_evidence.hpp; nothing: not asked.
  std::optional<double> least_log_odds;
  // What speaks for hands inside of their outline; nothing: shapes alone do.
  std::optional<TextureModel> texture;
};

// As fits the templates: whether there are many of each gesture or an example or two, and whether
// the gestures are a few that were chosen to be told apart, or numerals, which differ by less.
GestureDetectorOptions options_for(const TemplateSet& set,
                                   std::optional<TextureModel> texture = std::nullopt);

// How far a hand that is straight on its forearm is turned from upright, rad clockwise; nothing
// where no forearm was seen.
std::optional<double> straight_angle(const HandShape& shape);

// What a hand's shape gives when sampled by rings turned by `turn`.
RingSignature signature_of(const HandShape& shape, const RingLayout& layout, double turn = 0);

// A gesture learnt from one example: turned so that its forearm points down, where it has one.
GestureTemplate template_of(const std::string& gesture, const HandShape& shape,
                            const RingLayout& layout);

// The angle of a match of the shape sampled from `turn` on, finer than the step between samples.
double fine_angle(const RingMatcher& matcher, const HandShape& shape, const RingMatch& match,
                  double turn = 0);

// The angle to the template of a gesture (by its place in the matcher's) that is nearest when
// sampling begins at the shape's own longest extent: a turned copy is sampled at the same places,
// so that it has the same nearest template, and turned copies agree within half a degree but for
// near ties.
double own_angle(const RingMatcher& matcher, const HandShape& shape, std::size_t gesture,
                 bool mirrored);

// The blobs of a mask, without the shadow of the hand and, where the largest is no hand, parted
// from walls, both by `bgr`.
std::vector<HandBlob> find_hands(const HandFinder& finder, const cv::Mat& skin, const cv::Mat& bgr);

bool any_told(const HandObservations& hands);
// Of two looks at one picture, the one that tells a gesture, else the one whose likeliest hand is
// likelier.
HandObservations likelier(HandObservations one, HandObservations other);

class GestureDetector {
 public:
  explicit GestureDetector(TemplateSet set, const GestureDetectorOptions& options = {});

  const RingMatcher& matcher() const { return matcher_; }
  // `skin`: CV_8UC1, 0 off the skin.
  HandObservations detect(const cv::Mat& skin) const;
  // The same in what `bgr` (CV_8UC3, of the mask's size) shows the skin may be: with the shadow
  // that a hand casts or without, and where no gesture is told, without walls of skin's colour;
  // whichever is likeliest to be hands.
  HandObservations detect(const cv::Mat& skin, const cv::Mat& bgr) const;
  // The same in each of several masks until a gesture is told; where none is, what the first shows,
  // so that hands do not jump from one mask's to another's.
  HandObservations detect(const std::vector<cv::Mat>& skins, const cv::Mat& bgr) const;

 private:
  // A mask, and how it came about.
  struct Segmentation {
    cv::Mat skin;
    cv::Mat bgr;  // empty: the mask alone is known
    bool parted;  // from walls
  };
  HandObservations detect_in(const Segmentation& segmentation) const;
  HandObservation observe(const HandBlob& blob, const Segmentation& segmentation) const;
  // Log odds by the texture alone; 0 where it is not known.
  double texture_of(const HandObservation& seen, const cv::Mat& bgr) const;
  bool is_told(const HandObservation& seen, double margin) const;

  GestureDetectorOptions options_;
  HandFinder finder_;
  RingMatcher matcher_;
  std::vector<bool> plain_;  // of each gesture; see HandEvidence
};

}  // namespace armsreach::gesture
