#include "vision/gesture/skin_segmenter.hpp"

#include <algorithm>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {

SkinSegmenter::SkinSegmenter(ColorModel model, const SkinOptions& options)
    : base_(std::move(model)),
      model_(base_),
      options_(options),
      skin_(std::max(0, class_named(model_, kSkin))),
      table_(ColorTable::posteriors(model_, skin_)) {}

cv::Mat SkinSegmenter::reduced(const cv::Mat& bgr) const {
  const int factor = bgr.cols / options_.width;
  if (factor < 2 || bgr.rows < factor) return bgr;
  cv::Mat small;
  cv::resize(bgr, small, {bgr.cols / factor, bgr.rows / factor}, 0, 0, cv::INTER_AREA);
  return small;
}

const cv::Mat& SkinSegmenter::segment(const cv::Mat& bgr) {
  CV_Assert(bgr.type() == CV_8UC3);
  const cv::Mat small = reduced(bgr);
  adapt_as_told(small);
  table_.apply(small, &posterior_);
  cv::blur(posterior_, posterior_, {options_.filter, options_.filter});
  if (small.size() != bgr.size()) cv::resize(posterior_, posterior_, bgr.size());
  cv::threshold(posterior_, mask_, 127, 255, cv::THRESH_BINARY);
  return mask_;
}

void SkinSegmenter::adapt_as_told(const cv::Mat& reduced) {
  switch (options_.adaptation) {
    case SkinOptions::Adaptation::none:
      return;
    case SkinOptions::Adaptation::image:
      reset();
      adapt_reduced(reduced);
      return;
    case SkinOptions::Adaptation::stream:
      if (frames_++ % options_.interval != 0) return;
      refused_ = adapt_reduced(reduced) ? 0 : refused_ + 1;
      if (adapted_ && refused_ >= options_.patience) reset();
      return;
  }
}

bool SkinSegmenter::adapt(const cv::Mat& bgr) { return adapt_reduced(reduced(bgr)); }

bool SkinSegmenter::adapt_reduced(const cv::Mat& bgr) {
  SkinReestimation result = reestimate_skin(base_, skin_, bgr);
  evidence_ = result.evidence;
  if (result.refused) return false;
  model_ = std::move(result.model);
  table_ = ColorTable::posteriors(model_, skin_);
  adapted_ = true;
  return true;
}

void SkinSegmenter::reset() {
  if (!adapted_) return;
  model_ = base_;
  table_ = ColorTable::posteriors(model_, skin_);
  adapted_ = false;
}

}  // namespace armsreach::gesture
