// An image as template search reads it: whole grey values as floats, at full and half size.
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

namespace armsreach::mono_slam {

class SearchImage {
 public:
  // CV_8UC1. Reuses the memory of the image before.
  void set(const cv::Mat& grey);

  struct Level {
    int width = 0;
    int height = 0;
    int stride = 0;
    std::vector<float> samples;  // readable beyond the last one by a kernel's reach

    const float* at(int x, int y) const { return samples.data() + y * stride + x; }
  };
  const Level& full() const { return full_; }
  // Pixel (x, y) of it is pixel (2x, 2y) of the full one, smoothed binomially.
  const Level& half() const { return half_; }

 private:
  Level full_;
  Level half_;
};

}  // namespace armsreach::mono_slam
