// Colour and depth images that arrive one by one, paired by the time their device gave them.
#pragma once

#include <deque>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "vision/core/time.hpp"

namespace armsreach {

struct TimedImage {
  cv::Mat image;
  Timestamp time = 0;     // of the device's own clock, which colour and depth share
  Timestamp arrival = 0;  // of the machine's monotonic clock
};

struct ImagePair {
  TimedImage color;
  TimedImage depth;
};

class ImagePairs {
 public:
  explicit ImagePairs(double rate);  // Hz, of the slower stream

  // The pair that this image completes. Each image is in one pair at most; what is older than a
  // pair is given up.
  std::optional<ImagePair> add_color(TimedImage color);
  std::optional<ImagePair> add_depth(TimedImage depth);

 private:
  std::optional<std::size_t> nearest(const std::deque<TimedImage>& waiting, Timestamp time) const;

  Timestamp tolerance_;
  std::deque<TimedImage> color_;
  std::deque<TimedImage> depth_;
};

}  // namespace armsreach
