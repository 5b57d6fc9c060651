// How often each colour occurs among the pixels of a class. Brightness is counted beside the U,V
// plane, as if it were independent of U and V.
#pragma once

#include <array>

#include <opencv2/core/mat.hpp>

#include "vision/gesture/color_space.hpp"

namespace armsreach::gesture {

struct ColorHistogram {
  ColorHistogram() : uv(kUvSide, kUvSide, 0.0F) {}
  ColorHistogram(const ColorHistogram& other) { *this = other; }
  ColorHistogram& operator=(const ColorHistogram& other);

  void add(const ColorCell& cell, float weight = 1);
  double count() const;  // pixels
  bool empty() const { return count() <= 0; }

  cv::Mat1f uv;  // row v, column u
  std::array<float, kLumas> luma{};
};

// Adds the pixels of a CV_8UC3 BGR image where the CV_8UC1 mask is not 0 (an empty mask: all).
void add_pixels(const cv::Mat& bgr, const cv::Mat& mask, const ColorProjection& projection,
                ColorHistogram* histogram);

// Spread in U,V by a Gaussian of that deviation [cells]: what few examples stand for.
ColorHistogram spread(const ColorHistogram& histogram, double deviation);

// The share (1 - weight) of a's distribution and `weight` of b's; of the one that is not empty
// where the other is. Counts 1.
ColorHistogram blend(const ColorHistogram& a, const ColorHistogram& b, double weight);

// p(c|C), smoothed a little, with `unseen` of the probability spread evenly over all colours.
struct ColorLikelihood {
  ColorLikelihood(const ColorHistogram& histogram, double unseen);

  cv::Mat1f uv;                    // sums to 1
  std::array<float, kLumas> luma;  // sums to 1
};

}  // namespace armsreach::gesture
