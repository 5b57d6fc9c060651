#include "tests/unit/vision/mapping/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace armsreach::mapping::test {

using Eigen::Vector3d;

Shape plane(const Vector3d& normal, double offset) {
  return [=](const Vector3d& o, const Vector3d& d) -> std::optional<double> {
    const double t = (offset - normal.dot(o)) / normal.dot(d);
    if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
    return t;
  };
}

Shape sphere(const Vector3d& centre, double radius) {
  return [=](const Vector3d& o, const Vector3d& d) -> std::optional<double> {
    const Vector3d from = o - centre;
    const double a = d.squaredNorm();
    const double b = from.dot(d);
    const double square = b * b - a * (from.squaredNorm() - radius * radius);
    if (square < 0) return std::nullopt;
    const double t = (-b - std::sqrt(square)) / a;
    if (!(t > 0)) return std::nullopt;
    return t;
  };
}

Shape box(const Vector3d& low, const Vector3d& high) {
  return [=](const Vector3d& o, const Vector3d& d) -> std::optional<double> {
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      if (d[i] == 0) {
        if (o[i] < low[i] || o[i] > high[i]) return std::nullopt;
        continue;
      }
      const double a = (low[i] - o[i]) / d[i];
      const double b = (high[i] - o[i]) / d[i];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (!(enter > 0) || enter > leave) return std::nullopt;
    return enter;
  };
}

Shape nearest_of(std::vector<Shape> shapes) {
  return
      [shapes = std::move(shapes)](const Vector3d& o, const Vector3d& d) -> std::optional<double> {
        std::optional<double> best;
        for (const Shape& shape : shapes) {
          const auto t = shape(o, d);
          if (t && (!best || *t < *best)) best = t;
        }
        return best;
      };
}

cv::Mat depth_of(const Shape& shape, const Camera& camera, const Pose& world_from_camera) {
  cv::Mat depth(camera.height, camera.width, CV_32FC1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vector3d ray = world_from_camera.rotation() *
                           unproject(camera, Vector3d(u, v, 0).head<2>());  // z = 1 in the camera
      const auto t = shape(world_from_camera.translation(), ray);
      depth.at<float>(v, u) = t ? static_cast<float>(*t) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return depth;
}

Camera small_camera() { return pinhole(80, 60, 73.125, 73.125, 39.5, 29.5); }

Pose looking_at(const Vector3d& eye, const Vector3d& target) {
  const Vector3d forward = (target - eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rotation;
  rotation << right, forward.cross(right), forward;
  return Pose(Eigen::Quaterniond(rotation), eye);
}

VoxelMap map_of(const Shape& shape, const std::vector<Pose>& poses, const VoxelMapOptions& options,
                const Camera& camera) {
  VoxelMap map(options);
  for (const Pose& pose : poses) {
    const cv::Mat depth = depth_of(shape, camera, pose);
    map.insert(depth, cv::Mat(depth.size(), CV_32FC1, cv::Scalar(0.5)), cv::Mat(), camera, pose);
  }
  return map;
}

}  // namespace armsreach::mapping::test
