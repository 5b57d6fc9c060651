#include "tests/support/synthetic_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace armsreach::test {
namespace {

struct Interval {
  double in, out;
};

// Where a ray is inside a box; empty (in > out) where it misses.
Interval inside(const Box& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  Interval interval{-std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.least(axis) - origin(axis)) / direction(axis);
    const double b = (box.most(axis) - origin(axis)) / direction(axis);
    interval.in = std::max(interval.in, std::min(a, b));
    interval.out = std::min(interval.out, std::max(a, b));
  }
  return interval;
}

// Waves of 0.25 to 2 m, so that images of 80 pixels still resolve them.
double texture(const Eigen::Vector3d& p) {
  return 0.5 + 0.14 * std::sin(7 * p.x() + 3 * p.y() - 4 * p.z()) +
         0.12 * std::sin(-5 * p.x() + 9 * p.y() + 6 * p.z() + 1) +
         0.10 * std::sin(15 * p.x() - 13 * p.y() + 14 * p.z() + 2);
}

}  // namespace

FramePtr SyntheticRoom::frame(const std::shared_ptr<const SensorInfo>& sensor,
                              const Pose& world_from_camera, std::int64_t index) const {
  const Camera& camera = *sensor->depth_camera;
  std::mt19937_64 random(seed * 1000003 + static_cast<std::uint64_t>(index));
  std::normal_distribution<double> normal;
  auto out = std::make_shared<Frame>();
  out->index = index;
  out->time = timestamp_from_seconds(static_cast<double>(index) / sensor->rate);
  out->sensor = sensor;
  out->world_from_camera = world_from_camera;
  out->depth = cv::Mat(camera.height, camera.width, CV_32FC1);
  out->color = cv::Mat(camera.height, camera.width, CV_8UC1);
  const Eigen::Matrix3d rotation = world_from_camera.rotation_matrix();
  const Eigen::Vector3d& origin = world_from_camera.translation();
  for (int row = 0; row < camera.height; ++row) {
    for (int col = 0; col < camera.width; ++col) {
      const Eigen::Vector3d ray((col - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1);
      const Eigen::Vector3d direction = rotation * ray;
      double depth = inside(walls, origin, direction).out;
      for (const Box& box : furniture) {
        const Interval hit = inside(box, origin, direction);
        if (hit.in > 0 && hit.in <= hit.out) depth = std::min(depth, hit.in);
      }
      double grey = brightness + (textured ? texture(origin + depth * direction) : 0.5);
      if (intensity_noise > 0) grey += intensity_noise * normal(random);
      if (depth_noise > 0) depth += depth_noise * depth * depth * normal(random);
      out->depth.at<float>(row, col) = static_cast<float>(depth);
      out->color.at<std::uint8_t>(row, col) =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(grey, 0.0, 1.0)));
    }
  }
  return out;
}

std::shared_ptr<const SensorInfo> synthetic_sensor(int width) {
  auto sensor = std::make_shared<SensorInfo>();
  sensor->depth_camera = resized(pinhole(640, 480, 525, 525, 319.5, 239.5), width, width * 3 / 4);
  sensor->color_camera = sensor->depth_camera;
  return sensor;
}

}  // namespace armsreach::test
