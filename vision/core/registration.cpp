#include "vision/core/registration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armsreach {
namespace {

struct Footprint {
  double half_width;  // px of the target
  double half_height;
};

void splat(cv::Mat& target, const Eigen::Vector2d& pixel, const Footprint& foot, float z) {
  const int left = std::max(static_cast<int>(std::ceil(pixel.x() - foot.half_width)), 0);
  const int top = std::max(static_cast<int>(std::ceil(pixel.y() - foot.half_height)), 0);
  const int right =
      std::min(static_cast<int>(std::floor(pixel.x() + foot.half_width)), target.cols - 1);
  const int bottom =
      std::min(static_cast<int>(std::floor(pixel.y() + foot.half_height)), target.rows - 1);
  for (int y = top; y <= bottom; ++y) {
    float* line = target.ptr<float>(y);
    for (int x = left; x <= right; ++x) {
      if (!(line[x] <= z)) line[x] = z;  // NaN or farther
    }
  }
}

}  // namespace

cv::Mat registered_depth(const cv::Mat& depth, const Camera& camera, const Camera& target,
                         const Pose& target_from_camera) {
  CV_Assert(depth.type() == CV_32FC1);
  CV_Assert(depth.cols == camera.width && depth.rows == camera.height);
  cv::Mat registered(target.height, target.width, CV_32FC1,
                     cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  const Eigen::Matrix3d rotation = target_from_camera.rotation_matrix();
  const Eigen::Vector3d& translation = target_from_camera.translation();
  // A slightly larger footprint than a sample leaves no cracks where the view is stretched.
  constexpr double kStretch = 1.1;
  for (int y = 0; y < depth.rows; ++y) {
    const float* line = depth.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x) {
      if (!(line[x] > 0)) continue;
      const double z = static_cast<double>(line[x]);
      const Eigen::Vector3d point =
          rotation * (z * unproject(camera, Eigen::Vector2d(x, y))) + translation;
      const auto pixel = project(target, point);
      if (!pixel) continue;
      const double nearer = kStretch * 0.5 * z / point.z();
      const Footprint foot{std::max(nearer * target.fx / camera.fx, 0.5),
                           std::max(nearer * target.fy / camera.fy, 0.5)};
      splat(registered, *pixel, foot, static_cast<float>(point.z()));
    }
  }
  return registered;
}

}  // namespace armsreach
