// Skin in a colour image: table of posteriors, box filter, majority [wearable paper].
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/gesture/color_model.hpp"
#include "vision/gesture/color_table.hpp"
#include "vision/gesture/skin_reestimation.hpp"

namespace armsreach::gesture {

struct SkinOptions {
  enum class Adaptation {
    none,    // the model as it is
    image,   // each image is a scene of its own: re-estimated from the model, where that is wise
    stream,  // images of one scene: re-estimated now and then, and kept in between
  };
  Adaptation adaptation = Adaptation::none;
  int width = 320;    // px: images at least twice as wide are segmented at an integer fraction
  int filter = 5;     // px: side of the box filter, at that size
  int interval = 15;  // frames of a stream between re-estimations
  int patience = 4;   // refused re-estimations in a row after which what was learnt is dropped
};

class SkinSegmenter {
 public:
  // Finds the model's class "skin", or its first.
  explicit SkinSegmenter(ColorModel model, const SkinOptions& options = {});

  // CV_8UC3 BGR of any size to CV_8UC1 of the same size: 255 skin, 0 not. Valid until the next
  // call.
  const cv::Mat& segment(const cv::Mat& bgr);
  // The same by the model given at the start, which is right where what was learnt since is not;
  // empty where nothing was learnt.
  cv::Mat segment_unadapted(const cv::Mat& bgr) const;
  // Both, as far as there are two; the first is valid until the next call.
  std::vector<cv::Mat> segmentations(const cv::Mat& bgr);

  // Re-estimates from this image, always from the model given at the start, so that nothing drifts.
  // Returns false, and keeps what is in use, where the evidence speaks against it.
  bool adapt(const cv::Mat& bgr);
  void reset();  // back to the model given at the start

  const ColorModel& model() const { return model_; }  // in use now
  bool adapted() const { return adapted_; }
  const SkinEvidence& evidence() const { return evidence_; }  // of the last re-estimation

 private:
  cv::Mat reduced(const cv::Mat& bgr) const;
  void segment_by(const ColorTable& table, const cv::Mat& reduced, const cv::Size& size,
                  cv::Mat* posterior, cv::Mat* mask) const;
  bool adapt_reduced(const cv::Mat& bgr);
  void adapt_as_told(const cv::Mat& reduced);

  ColorModel base_, model_;
  SkinOptions options_;
  int skin_;
  ColorTable base_table_, table_;
  bool adapted_ = false;
  SkinEvidence evidence_;
  std::int64_t frames_ = 0;
  int refused_ = 0;  // in a row
  cv::Mat posterior_, mask_;
};

}  // namespace armsreach::gesture
