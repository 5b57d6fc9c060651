// Made-up pictures to look for patches in.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace armsreach::mono_slam::test {

// Blurred noise of full contrast: distinct everywhere.
inline cv::Mat speckles(int width, int height, int seed, double blur = 2) {
  cv::RNG random(static_cast<std::uint64_t>(seed));
  cv::Mat out(height, width, CV_8UC1);
  random.fill(out, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(out, out, cv::Size(), blur);
  cv::normalize(out, out, 0, 255, cv::NORM_MINMAX);
  return out;
}

// The content moved by so much, below the pixel.
inline cv::Mat shifted(const cv::Mat& image, double dx, double dy) {
  cv::Mat out;
  const cv::Mat by = (cv::Mat_<double>(2, 3) << 1, 0, dx, 0, 1, dy);
  cv::warpAffine(image, out, by, image.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return out;
}

}  // namespace armsreach::mono_slam::test
