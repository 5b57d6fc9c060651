#include "vision/registration/color_edges.hpp"

#include <opencv2/imgproc.hpp>

#include "vision/core/pyramid.hpp"

namespace armsreach {
namespace {

constexpr int kReduction = 2;
constexpr int kSurroundings = 41;  // px of the reduced image
constexpr float kFaint = 2.0F;     // grey levels a pixel: changes like these are noise

cv::Mat derivative(const cv::Mat& grey, int dx, int dy) {
  cv::Mat change;
  cv::Mat magnitude;
  cv::Sobel(grey, change, CV_32F, dx, dy, 3, 255 * 0.25);
  cv::convertScaleAbs(change, magnitude);
  return magnitude;
}

cv::Mat field(const cv::Mat& magnitude, double sigma) {
  cv::Mat strength;
  cv::Mat surroundings;
  magnitude.convertTo(strength, CV_32F);
  cv::boxFilter(strength, surroundings, CV_32F, {kSurroundings, kSurroundings});
  cv::GaussianBlur(strength, strength, {}, sigma / kReduction);
  return strength / (strength + surroundings + kFaint);
}

}  // namespace

ColorEdges color_edges(const cv::Mat& image) {
  const cv::Mat grey = reduced_intensity(image, kReduction);
  return {derivative(grey, 1, 0), derivative(grey, 0, 1)};
}

EdgeField::EdgeField(const ColorEdges& edges, double sigma)
    : along_x_(field(edges.along_x, sigma)),
      along_y_(field(edges.along_y, sigma)),
      mean_(static_cast<float>(0.5 * (cv::mean(along_x_)[0] + cv::mean(along_y_)[0]))) {}

float EdgeField::at(float x, float y, Across across) const {
  const cv::Mat& field = across == Across::columns ? along_x_ : along_y_;
  const float u = (x + 0.5F) / kReduction - 0.5F;
  const float v = (y + 0.5F) / kReduction - 0.5F;
  if (!(u >= 0 && v >= 0 && u < static_cast<float>(field.cols - 1) &&
        v < static_cast<float>(field.rows - 1))) {
    return mean_;
  }
  const int col = static_cast<int>(u);
  const int row = static_cast<int>(v);
  const float fu = u - static_cast<float>(col);
  const float fv = v - static_cast<float>(row);
  const float* upper = field.ptr<float>(row) + col;
  const float* lower = field.ptr<float>(row + 1) + col;
  const float above = upper[0] + fu * (upper[1] - upper[0]);
  const float below = lower[0] + fu * (lower[1] - lower[0]);
  return above + fv * (below - above);
}

}  // namespace armsreach
