#include "app/pipelines/background.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace armsreach::app {
namespace {

constexpr int kDepthRadius = 2;  // px: depth has holes and jumps, its median is taken

std::optional<double> depth_at(const cv::Mat& depth, const Eigen::Vector2d& pixel) {
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  const cv::Rect around =
      cv::Rect(x - kDepthRadius, y - kDepthRadius, 2 * kDepthRadius + 1, 2 * kDepthRadius + 1) &
      cv::Rect(0, 0, depth.cols, depth.rows);
  std::vector<float> known;
  for (int row = around.y; row < around.y + around.height; ++row) {
    for (int col = around.x; col < around.x + around.width; ++col) {
      const float z = depth.at<float>(row, col);
      if (z > 0) known.push_back(z);
    }
  }
  if (known.empty()) return std::nullopt;
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  return static_cast<double>(*middle);
}

}  // namespace

BackgroundCamera background_camera(const Frame& frame) {
  const SensorInfo& sensor = *frame.sensor;
  const bool from_depth = frame.color.empty() || !sensor.color_camera;
  BackgroundCamera background;
  background.camera = from_depth ? sensor.camera() : *sensor.color_camera;
  if (!from_depth && sensor.depth_camera)
    background.background_from_camera = sensor.color_from_depth;
  background.sees_depth = sensor.registered || from_depth;
  return background;
}

std::optional<Ray> ray_through(const TrackedFrame& tracked, const Eigen::Vector2d& pixel) {
  if (!pose_known(tracked)) return std::nullopt;
  const BackgroundCamera background = background_camera(*tracked.frame);
  const Pose world_from_background =
      tracked.world_from_camera * background.background_from_camera.inverse();
  return Ray{world_from_background.translation(),
             world_from_background.rotation() * unproject(background.camera, pixel).normalized()};
}

std::optional<Eigen::Vector3d> point_in_world_at(const TrackedFrame& tracked,
                                                 const Eigen::Vector2d& pixel) {
  const Frame& frame = *tracked.frame;
  const BackgroundCamera background = background_camera(frame);
  if (!pose_known(tracked) || frame.depth.empty() || !background.sees_depth) return std::nullopt;
  const Camera& camera = background.camera;
  const Eigen::Vector2d ratio(static_cast<double>(frame.depth.cols) / camera.width,
                              static_cast<double>(frame.depth.rows) / camera.height);
  const auto z = depth_at(frame.depth, pixel.cwiseProduct(ratio));
  if (!z) return std::nullopt;
  return tracked.world_from_camera *
         (background.background_from_camera.inverse() * (*z * unproject(camera, pixel)));
}

}  // namespace armsreach::app
