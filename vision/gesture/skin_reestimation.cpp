#include "vision/gesture/skin_reestimation.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vision/gesture/color_table.hpp"

namespace armsreach::gesture {
namespace {

constexpr int kRounds = 3;
constexpr double kBorderWeight = 0.2;  // of the border's colours in the background at the start
constexpr double kImageWeight = 0.9;   // of the image's colours against the model's
constexpr int kFilter = 5;             // px

cv::Mat border_of(const cv::Size& size) {
  const int width = std::max(1, std::max(size.width, size.height) / 50);
  cv::Mat border(size, CV_8UC1, cv::Scalar(255));
  const cv::Rect inside(width, width, size.width - 2 * width, size.height - 2 * width);
  if (inside.width > 0 && inside.height > 0) border(inside) = cv::Scalar(0);
  return border;
}

ColorHistogram colors_of(const cv::Mat& bgr, const cv::Mat& mask, const ColorModel& model) {
  ColorHistogram colors;
  add_pixels(bgr, mask, ColorProjection(model.balance), &colors);
  return colors;
}

double share(const cv::Mat& part, const cv::Mat& whole) {
  const int all = cv::countNonZero(whole);
  return all > 0 ? static_cast<double>(cv::countNonZero(part & whole)) / all : 0;
}

double overlap(const ColorHistogram& a, const ColorHistogram& b) {
  const ColorLikelihood one(a, 0), other(b, 0);
  return cv::sum(cv::min(one.uv, other.uv))[0];
}

double compactness(const cv::Mat& blob) {
  const int area = cv::countNonZero(blob);
  const int side = std::max(3, static_cast<int>(0.2 * std::sqrt(area)));
  cv::Mat opened;
  cv::morphologyEx(blob, opened, cv::MORPH_OPEN, cv::Mat::ones(side, side, CV_8UC1));
  return share(opened, blob);
}

}  // namespace

std::optional<std::string> refusal(const SkinEvidence& evidence) {
  if (evidence.area < 0.005) return "there is hardly any skin";
  if (evidence.area > 0.5) return "half the image would be skin";
  if (evidence.border > 0.35) return "it covers the border as a wall does";
  if (evidence.compact < 0.5) return "it is scattered rather than a hand";
  if (evidence.agreement < 0.6) return "it drifted off to other colours";
  if (evidence.overlap > 0.4) return "its colours are those of the background";
  return std::nullopt;
}

cv::Mat skin_mask(const ColorModel& model, int skin, const cv::Mat& bgr, int filter) {
  cv::Mat posterior;
  ColorTable::posteriors(model, skin).apply(bgr, &posterior);
  cv::blur(posterior, posterior, cv::Size(filter, filter));
  return posterior > 127;
}

cv::Mat largest_blob(const cv::Mat& mask) {
  cv::Mat labels, stats, centroids;
  const int blobs = cv::connectedComponentsWithStats(mask, labels, stats, centroids, 8, CV_32S);
  int largest = 0;
  for (int i = 1; i < blobs; ++i) {
    const auto area = [&](int label) { return stats.at<int>(label, cv::CC_STAT_AREA); };
    if (largest == 0 || area(i) > area(largest)) largest = i;
  }
  if (largest == 0) return cv::Mat::zeros(mask.size(), CV_8UC1);
  return labels == largest;
}

SkinReestimation reestimate_skin(const ColorModel& model, int skin, const cv::Mat& bgr) {
  const cv::Mat border = border_of(bgr.size());
  const cv::Mat before = skin_mask(model, skin, bgr, kFilter);
  SkinReestimation result{model, {}, std::nullopt};
  const ColorHistogram background =
      blend(model.background, colors_of(bgr, border, model), kBorderWeight);
  result.model.background = background;
  cv::Mat blob = largest_blob(skin_mask(result.model, skin, bgr, kFilter));
  ColorHistogram inside, outside;
  for (int round = 0; round < kRounds; ++round) {
    inside = colors_of(bgr, blob, model);
    outside = colors_of(bgr, ~blob, model);
    result.model.classes[skin].pixels = blend(model.classes[skin].pixels, inside, kImageWeight);
    result.model.background = blend(background, outside, kImageWeight);
    blob = largest_blob(skin_mask(result.model, skin, bgr, kFilter));
  }
  result.evidence.area = share(blob, cv::Mat(bgr.size(), CV_8UC1, cv::Scalar(255)));
  result.evidence.border = share(blob, border);
  result.evidence.compact = compactness(blob);
  result.evidence.agreement = share(before, blob);
  result.evidence.overlap = overlap(inside, outside);
  result.refused = refusal(result.evidence);
  if (result.refused) result.model = model;
  return result;
}

}  // namespace armsreach::gesture
