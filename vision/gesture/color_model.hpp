// Classes of colours told apart by Bayes' rule with uniform priors, winner takes all [wearable
// paper, skin detection]: skin against background, or any number of named classes.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core/matx.hpp>

#include "vision/gesture/color_histogram.hpp"

namespace armsreach::gesture {

struct ColorClass {
  std::string name;
  ColorHistogram pixels;
};

struct ColorModel {
  ColorHistogram background;
  std::vector<ColorClass> classes;
  bool with_luma = false;      // white, grey and black things differ in nothing else
  cv::Vec3f level{0, 0, 0};    // M_T: the first class's level of each channel, B G R; 0: unknown
  cv::Vec3f balance{1, 1, 1};  // c' = balance * c, each channel, before anything else
};

constexpr const char* kSkin = "skin";

// Index of the class of that name, or -1.
int class_named(const ColorModel& model, const std::string& name);

}  // namespace armsreach::gesture
