#include "vision/gesture/skin_segmenter.hpp"

#include <algorithm>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {

SkinSegmenter::SkinSegmenter(ColorModel model, const SkinOptions& options)
    : base_(std::move(model)),
      model_(base_),
      options_(options),
      skin_(std::max(0, class_named(model_, "skin"))),
      table_(ColorTable::posteriors(model_, skin_)) {}

cv::Mat SkinSegmenter::skin_of(const cv::Mat& bgr) {
  table_.apply(bgr, &posterior_);
  cv::blur(posterior_, filtered_, cv::Size(options_.filter, options_.filter));
  return filtered_ > 127;
}

const cv::Mat& SkinSegmenter::segment(const cv::Mat& bgr) {
  const int factor = std::max(1, bgr.cols / options_.width);
  if (factor == 1) {
    mask_ = skin_of(bgr);
    return mask_;
  }
  cv::resize(bgr, reduced_, cv::Size(bgr.cols / factor, bgr.rows / factor), 0, 0, cv::INTER_AREA);
  skin_of(reduced_);
  cv::resize(filtered_, mask_, bgr.size(), 0, 0, cv::INTER_LINEAR);
  mask_ = mask_ > 127;
  return mask_;
}

bool SkinSegmenter::adapt(const cv::Mat&) { return false; }

void SkinSegmenter::reset() {
  model_ = base_;
  table_ = ColorTable::posteriors(model_, skin_);
}

}  // namespace armsreach::gesture
