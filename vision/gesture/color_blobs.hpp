// Things known by their colour, and which of them a hand holds: a cue of what its owner is doing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/gesture/color_model.hpp"
#include "vision/gesture/color_table.hpp"
#include "vision/gesture/hand_observation.hpp"

namespace armsreach::gesture {

// Pixels are those of the image.
struct ColorBlob {
  std::string name;
  cv::Rect box;
  double area = 0;  // px^2
  Eigen::Vector2d center{0, 0};
};
using ColorBlobs = std::vector<ColorBlob>;

struct ColorBlobOptions {
  int width = 320;            // px: images at least twice as wide are searched at a fraction
  int filter = 5;             // px: side of the box filter, at that size
  double least_area = 0.001;  // of the image
};

class ColorBlobFinder {
 public:
  explicit ColorBlobFinder(ColorModel model, const ColorBlobOptions& options = {});

  // In a CV_8UC3 BGR image of any size, the largest first. `hidden` (CV_8UC1 of its size, or empty)
  // is not 0 where nothing is looked for: the hand itself.
  ColorBlobs find(const cv::Mat& bgr, const cv::Mat& hidden = {});

 private:
  void add_blobs(int class_index, const cv::Size2d& scale, ColorBlobs* blobs);

  ColorModel model_;
  ColorBlobOptions options_;
  ColorTable table_;
  cv::Mat classes_, filtered_;
};

// From the hand's outline to the blob's box, in widths of the hand (square root of its area); 0
// where they touch or one covers the other.
double gap(const ColorBlob& blob, const HandObservation& hand);

struct HeldOptions {
  double take = 0.06;     // widths of the hand: a thing this near touches it and is held
  double release = 0.45;  // and is let go beyond this
  int frames = 4;         // in a row that a change needs
};

// Which thing is held by any of the hands that could, over time. It changes its mind only after
// several frames that agree.
class HeldThing {
 public:
  explicit HeldThing(const HeldOptions& options = {}) : options_(options) {}

  // Of one frame. Returns the thing held now: its last blob, or nothing.
  const std::optional<ColorBlob>& update(const ColorBlobs& blobs, const HandObservations& hands);

 private:
  std::optional<ColorBlob> seen(const ColorBlobs& blobs, const HandObservations& hands) const;

  HeldOptions options_;
  std::optional<ColorBlob> held_;
  std::optional<std::string> candidate_;  // nothing: letting go
  int agreeing_ = 0;                      // frames in a row for the candidate
};

}  // namespace armsreach::gesture
