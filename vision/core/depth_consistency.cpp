#include "vision/core/depth_consistency.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armsreach {

void add_depth_differences(const cv::Mat& depth, const cv::Mat& other_depth, const Camera& camera,
                           const Pose& other_from_this, int step, std::vector<float>* differences) {
  constexpr double kOtherSurface = 0.1;
  for (int y = 0; y < depth.rows; y += step) {
    for (int x = 0; x < depth.cols; x += step) {
      const double z = static_cast<double>(depth.at<float>(y, x));
      if (!(z > 0)) continue;
      const Eigen::Vector3d point =
          other_from_this * Eigen::Vector3d(z * unproject(camera, Eigen::Vector2d(x, y)));
      const auto pixel = project(camera, point);
      if (!pixel || !camera.contains(*pixel)) continue;
      const double measured = static_cast<double>(other_depth.at<float>(
          static_cast<int>(std::lround(pixel->y())), static_cast<int>(std::lround(pixel->x()))));
      if (!(measured > 0)) continue;
      const double difference = std::abs(measured - point.z());
      if (difference > kOtherSurface * point.z()) continue;
      differences->push_back(static_cast<float>(difference / (point.z() * point.z())));
    }
  }
}

float median(std::vector<float>* values) {
  if (values->empty()) return std::numeric_limits<float>::quiet_NaN();
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return *middle;
}

}  // namespace armsreach
