// Colour models from examples: images with masks, lists of pixels.
#pragma once

#include <array>
#include <istream>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/result.hpp"
#include "vision/gesture/color_model.hpp"

namespace armsreach::gesture {

// Colours of one class and of everything else, as they are counted.
struct ColorExamples {
  ColorHistogram inside, outside;
  // Each channel's own histogram inside, B G R: for colour balance.
  std::array<std::array<double, 256>, 3> channels{};

  void add(const cv::Vec3b& bgr, bool is_inside);
};

// Adds an image (CV_8UC3 BGR, or a complaint about a grey one) with its mask (CV_8UC1 of the same
// size, not 0 inside). `where` names the image in complaints.
Status add_examples(const cv::Mat& bgr, const cv::Mat& mask, const std::string& where,
                    ColorExamples* examples);

// Adds a list of pixels: a line "b,g,r,label" each, label 1 inside and 2 not (the format of the UCI
// Skin Segmentation set). A first line that does not begin with a digit is a heading.
Status add_pixel_list(std::istream& in, const std::string& where, ColorExamples* examples);

// M or M_T: the median of each channel inside, B G R. (The paper takes the channel's peak; on the
// broad, flat histograms of real views that jumps about, and balancing by it does harm.)
cv::Vec3f level_of(const ColorExamples& examples);

// Skin against background from sets of examples of many people, each set counting alike; spread,
// since others differ.
Result<ColorModel> general_skin_model(const std::vector<ColorExamples>& sets,
                                      const std::string& where);

// The model fitted to one person under one light: learnt anew, with a little of the old.
Result<ColorModel> fitted_skin_model(const ColorModel& general, const ColorExamples& examples,
                                     const std::string& where);

// The model balanced for a view of the same user's skin in another light or through another camera,
// c' = (M_T / M) c [wearable paper]; only what the channels differ by, since U and V of a model do
// not depend on brightness alone. `level` is M; a model that does not know M_T stays as it is.
ColorModel balanced(const ColorModel& model, const cv::Vec3f& level);

// A model with the class of that name learnt anew, other classes as they were. Background comes
// from all examples ever taught.
Result<ColorModel> taught(const ColorModel& model, const std::string& name,
                          const ColorExamples& examples, const std::string& where);

}  // namespace armsreach::gesture
