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
      base_table_(ColorTable::posteriors(base_, skin_)),
      table_(base_table_) {}

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
  segment_by(table_, small, bgr.size(), &posterior_, &mask_);
  return mask_;
}

cv::Mat SkinSegmenter::segment_unadapted(const cv::Mat& bgr) const {
  CV_Assert(bgr.type() == CV_8UC3);
  cv::Mat posterior, mask;
  if (adapted_) segment_by(base_table_, reduced(bgr), bgr.size(), &posterior, &mask);
  return mask;
}

std::vector<cv::Mat> SkinSegmenter::segmentations(const cv::Mat& bgr) {
  std::vector<cv::Mat> masks{segment(bgr)};
  if (adapted_) masks.push_back(segment_unadapted(bgr));
  return masks;
}

void SkinSegmenter::segment_by(const ColorTable& table, const cv::Mat& reduced,
                               const cv::Size& size, cv::Mat* posterior, cv::Mat* mask) const {
  table.apply(reduced, posterior);
  cv::blur(*posterior, *posterior, {options_.filter, options_.filter});
  if (reduced.size() != size) cv::resize(*posterior, *posterior, size);
  cv::threshold(*posterior, *mask, 127, 255, cv::THRESH_BINARY);
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
  table_ = base_table_;
  adapted_ = false;
}

}  // namespace armsreach::gesture
