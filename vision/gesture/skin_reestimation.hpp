// Re-estimation of a skin model from one image without a mask: what the model finds is taken for
// skin, and the model learnt anew from it, a few times over [wearable paper: adaptation to the
// user; three rounds]. Alone it locks onto walls and wood of skin's colour. Two things prevent
// that: colours along the image's border count as background from the start (an arm crosses the
// border in one place, a wall nearly everywhere), and the result is refused when it does not look
// like hands.
#pragma once

#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "vision/gesture/color_model.hpp"

namespace armsreach::gesture {

// What was found, as shares 0..1.
struct SkinEvidence {
  double area = 0;       // of the image that the largest blob covers
  double border = 0;     // of the image's border that it covers
  double compact = 0;    // of the blob that an opening with a square of a fifth of its size leaves
  double agreement = 0;  // of the blob that the first model calls skin as well
  double overlap = 0;  // of the colours' distributions of skin and background: 0 apart, 1 the same
};

// Why such a blob is not to be learnt from, or nothing.
std::optional<std::string> refusal(const SkinEvidence& evidence);

struct SkinReestimation {
  ColorModel model;  // the new one; the given one where it was refused
  SkinEvidence evidence;
  std::optional<std::string> refused;
};
// `bgr` is CV_8UC3, best about 320 px wide; `skin` is the class's index.
SkinReestimation reestimate_skin(const ColorModel& model, int skin, const cv::Mat& bgr);

// 255 skin, 0 not, CV_8UC1: the posterior box filtered, then the majority.
cv::Mat skin_mask(const ColorModel& model, int skin, const cv::Mat& bgr, int filter);
// The largest 8-connected blob alone; all 0 where there is none.
cv::Mat largest_blob(const cv::Mat& mask);

}  // namespace armsreach::gesture
