#include "devices/sim/paint.hpp"

#include <opencv2/imgproc.hpp>

namespace armsreach::sim {

cv::Scalar bgr(const Color& color) { return {255 * color.z(), 255 * color.y(), 255 * color.x()}; }

Color between(const Color& a, const Color& b, double fraction) { return a + fraction * (b - a); }

cv::Mat canvas(int width, int height, const Color& color) {
  return cv::Mat(height, width, CV_32FC3, bgr(color));
}

cv::Mat noise(int width, int height, int columns, int rows, Random& random) {
  cv::Mat lattice(rows, columns, CV_32F);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) lattice.at<float>(y, x) = static_cast<float>(random.normal());
  }
  // Enlarged together with enough of its neighbours on the other side that the edges meet.
  constexpr int kBorder = 2;
  cv::Mat wrapped;
  cv::copyMakeBorder(lattice, wrapped, kBorder, kBorder, kBorder, kBorder, cv::BORDER_WRAP);
  const double scale_x = static_cast<double>(width) / columns;
  const double scale_y = static_cast<double>(height) / rows;
  const cv::Matx23d lattice_from_pixel(1 / scale_x, 0, kBorder, 0, 1 / scale_y, kBorder);
  cv::Mat enlarged;
  cv::warpAffine(wrapped, enlarged, lattice_from_pixel, {width, height},
                 cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return enlarged;
}

cv::Mat clouds(int width, int height, int cells, int octaves, double gain, Random& random) {
  cv::Mat sum = cv::Mat::zeros(height, width, CV_32F);
  double strength = 1;
  double power = 0;
  for (int octave = 0; octave < octaves; ++octave) {
    cv::scaleAdd(noise(width, height, cells << octave, cells << octave, random), strength, sum,
                 sum);
    power += strength * strength;
    strength *= gain;
  }
  return sum / std::sqrt(power);
}

void blend(cv::Mat& image, const Color& color, const cv::Mat& share) {
  const cv::Vec3f target(static_cast<float>(255 * color.z()), static_cast<float>(255 * color.y()),
                         static_cast<float>(255 * color.x()));
  for (int y = 0; y < image.rows; ++y) {
    cv::Vec3f* pixel = image.ptr<cv::Vec3f>(y);
    const float* s = share.ptr<float>(y);
    for (int x = 0; x < image.cols; ++x)
      pixel[x] += std::clamp(s[x], 0.0F, 1.0F) * (target - pixel[x]);
  }
}

void shade(cv::Mat& image, const cv::Mat& relief, double amount) {
  const float a = static_cast<float>(amount);
  for (int y = 0; y < image.rows; ++y) {
    cv::Vec3f* pixel = image.ptr<cv::Vec3f>(y);
    const float* r = relief.ptr<float>(y);
    for (int x = 0; x < image.cols; ++x) pixel[x] *= 1 + a * r[x];
  }
}

cv::Mat to_8_bit(const cv::Mat& image) {
  cv::Mat rounded;
  image.convertTo(rounded, CV_8UC3);
  return rounded;
}

}  // namespace armsreach::sim
