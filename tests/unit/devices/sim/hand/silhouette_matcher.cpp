#include "silhouette_matcher.hpp"

#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace armsreach::sim {

// The same area for all: a fifth of the square, so that long fingers stay inside.
SilhouetteMatcher::Bits SilhouetteMatcher::normalised(const cv::Mat& mask, double degrees) {
  const cv::Moments moments = cv::moments(mask, true);
  const double scale = kSide * std::sqrt(0.2 / moments.m00);
  const double c = scale * std::cos(degrees * std::numbers::pi / 180);
  const double s = scale * std::sin(degrees * std::numbers::pi / 180);
  const double x = moments.m10 / moments.m00;
  const double y = moments.m01 / moments.m00;
  const cv::Matx23d to_square(c, -s, kSide / 2 - c * x + s * y, s, c, kSide / 2 - s * x - c * y);
  cv::Mat square;
  cv::warpAffine(mask, square, to_square, {kSide, kSide}, cv::INTER_AREA);
  Bits bits;
  for (int i = 0; i < kSide * kSide; ++i)
    bits[static_cast<std::size_t>(i)] = square.at<std::uint8_t>(i / kSide, i % kSide) > 127;
  return bits;
}

void SilhouetteMatcher::add(int label, const cv::Mat& mask) {
  for (const double degrees : {-15.0, -10.0, -5.0, 0.0, 5.0, 10.0, 15.0})
    entries_.push_back({label, normalised(mask, degrees)});
}

int SilhouetteMatcher::name(const cv::Mat& mask) const {
  const Bits bits = normalised(mask, 0);
  double best = -1;
  int label = -1;
  for (const Entry& entry : entries_) {
    const double common = static_cast<double>((bits & entry.bits).count());
    const double either = static_cast<double>((bits | entry.bits).count());
    if (common <= best * either) continue;
    best = common / either;
    label = entry.label;
  }
  return label;
}

}  // namespace armsreach::sim
