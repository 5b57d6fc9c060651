// Skin in a colour image: table, box filter, majority. Source: wearable paper, skin detection.
#pragma once

#include <opencv2/core/mat.hpp>

#include "vision/gesture/color_model.hpp"
#include "vision/gesture/color_table.hpp"

namespace armsreach::gesture {

struct SkinOptions {
  enum class Adaptation {
    none,    // the model as it is
    image,   // each image is a scene of its own: start from the model and re-estimate
    stream,  // what was learnt in earlier frames is kept
  };
  Adaptation adaptation = Adaptation::none;
  int width = 320;  // px: images at least twice as wide are segmented at an integer fraction
  int filter = 5;   // px: side of the box filter, at that size
};

class SkinSegmenter {
 public:
  // The model's class "skin", or its first.
  explicit SkinSegmenter(ColorModel model, const SkinOptions& options = {});

  // CV_8UC3 BGR of any size to CV_8UC1 of the same size: 255 skin, 0 not. Valid until the next
  // call.
  const cv::Mat& segment(const cv::Mat& bgr);

  // Re-estimates from the largest blob of skin in this image; false where the evidence speaks
  // against it, and the model stays as it was.
  bool adapt(const cv::Mat& bgr);
  void reset();  // forgets what was learnt from images

  const ColorModel& model() const { return model_; }  // in use now

 private:
  cv::Mat skin_of(const cv::Mat& bgr);  // at the size of segmentation

  ColorModel base_;
  ColorModel model_;
  SkinOptions options_;
  int skin_;
  ColorTable table_;
  cv::Mat reduced_, posterior_, filtered_, mask_;
};

}  // namespace armsreach::gesture
