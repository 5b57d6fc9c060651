#include "vision/gesture/has_color.hpp"

#include <algorithm>

namespace armsreach::gesture {
namespace {

constexpr int kStep = 16;       // px between the pixels that are looked at
constexpr int kGreyLevels = 4;  // by which the channels of a grey image may differ

}  // namespace

bool has_color(const cv::Mat& image) {
  if (image.type() != CV_8UC3) return false;
  for (int y = 0; y < image.rows; y += kStep) {
    const auto* row = image.ptr<cv::Vec3b>(y);
    for (int x = 0; x < image.cols; x += kStep) {
      const auto [low, high] = std::minmax({row[x][0], row[x][1], row[x][2]});
      if (high - low > kGreyLevels) return true;
    }
  }
  return false;
}

}  // namespace armsreach::gesture
