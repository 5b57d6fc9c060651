#include "vision/gesture/color_pointing.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vision/gesture/skin_reestimation.hpp"

namespace armsreach::gesture {
namespace {

constexpr int kFilter = 5;            // px
constexpr double kNoise = 4;          // levels, deviation of a colour that never changes
constexpr double kLeastContrast = 3;  // deviations of the surroundings' colours
// Of the greatest contrast: a mask's thing may have several colours, a region is mostly background.
constexpr double kShareOfMask = 0.35;
constexpr double kShareOfRegion = 0.5;

struct ColorSpread {
  cv::Vec3d mean;
  cv::Matx33d inverse_covariance;
};

ColorSpread spread_of(const cv::Mat& bgr, const cv::Mat& mask) {
  cv::Vec3d sum;
  cv::Matx33d products = cv::Matx33d::zeros();
  double count = 0;
  for (int row = 0; row < bgr.rows; ++row) {
    for (int col = 0; col < bgr.cols; ++col) {
      if (!mask.at<std::uint8_t>(row, col)) continue;
      const cv::Vec3d color = bgr.at<cv::Vec3b>(row, col);
      sum += color;
      products += color * color.t();
      ++count;
    }
  }
  const cv::Vec3d mean = sum / std::max(1.0, count);
  const cv::Matx33d covariance = products * (1 / std::max(1.0, count)) - mean * mean.t() +
                                 cv::Matx33d::eye() * (kNoise * kNoise);
  return {mean, covariance.inv(cv::DECOMP_CHOLESKY)};
}

// Distance of each pixel's colour from the surroundings', in deviations, box filtered.
cv::Mat1f contrast(const cv::Mat& bgr, const ColorSpread& around) {
  cv::Mat1f distances(bgr.size());
  for (int row = 0; row < bgr.rows; ++row) {
    for (int col = 0; col < bgr.cols; ++col) {
      const cv::Vec3d d = cv::Vec3d(bgr.at<cv::Vec3b>(row, col)) - around.mean;
      distances(row, col) = static_cast<float>(std::sqrt(d.dot(around.inverse_covariance * d)));
    }
  }
  cv::blur(distances, distances, {kFilter, kFilter});
  return distances;
}

cv::Mat standing_out(const cv::Mat& bgr, const cv::Mat& around, double share_of_peak) {
  cv::Mat1f distances = contrast(bgr, spread_of(bgr, around));
  distances.setTo(0, around);
  double peak = 0;
  cv::minMaxLoc(distances, nullptr, &peak);
  return distances > std::max(kLeastContrast, share_of_peak * peak);
}

}  // namespace

cv::Mat own_colors(const cv::Mat& bgr, const cv::Mat& mask) {
  CV_Assert(bgr.type() == CV_8UC3 && mask.type() == CV_8UC1 && mask.size() == bgr.size());
  const cv::Mat around = mask == 0;
  if (cv::countNonZero(around) == 0) return mask.clone();
  return standing_out(bgr, around, kShareOfMask);
}

cv::Mat pointed_out(const cv::Mat& bgr, const std::optional<cv::Rect>& region) {
  CV_Assert(bgr.type() == CV_8UC3);
  const int border = std::max(2, std::min(bgr.cols, bgr.rows) / 12);
  const cv::Rect image({0, 0}, bgr.size());
  const cv::Rect inner(border, border, bgr.cols - 2 * border, bgr.rows - 2 * border);
  const cv::Rect inside = region.value_or(inner) & image;
  if (inside.empty()) return cv::Mat::zeros(bgr.size(), CV_8UC1);
  cv::Mat around(bgr.size(), CV_8UC1, cv::Scalar(255));
  around(inside) = cv::Scalar(0);
  if (cv::countNonZero(around) == 0) return cv::Mat(bgr.size(), CV_8UC1, cv::Scalar(255));
  return largest_blob(standing_out(bgr, around, kShareOfRegion));
}

}  // namespace armsreach::gesture
