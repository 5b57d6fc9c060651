#include "tests/unit/vision/relocalisation/painted_room.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <opencv2/imgproc.hpp>

#include "vision/core/camera.hpp"

namespace armsreach::test {
namespace {

constexpr double kHalf = 1.5;     // m, from the centre of the room to each wall
constexpr int kPaintSize = 1024;  // px along a wall: 3 mm each
constexpr int kShapes = 1500;     // on a wall

cv::Mat painting(std::mt19937_64& random) {
  const auto below = [&](int limit) {
    return static_cast<int>(random() % static_cast<std::uint64_t>(limit));
  };
  cv::Mat paint(kPaintSize, kPaintSize, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < kShapes; ++i) {
    const cv::Point centre(below(kPaintSize), below(kPaintSize));
    const cv::Size axes(4 + below(30), 4 + below(30));
    cv::ellipse(paint, centre, axes, below(180), 0, 360, cv::Scalar(below(256)), cv::FILLED);
  }
  return paint;
}

struct Hit {
  int wall = 0;
  cv::Point2d paint;  // px of the painting
  double length = 0;  // in units of the ray
};

// Where a ray from inside leaves the room.
Hit leave(const Eigen::Vector3d& from, const Eigen::Vector3d& ray) {
  Hit hit;
  hit.length = std::numeric_limits<double>::infinity();
  int axis = 0;
  for (int i = 0; i < 3; ++i) {
    const double length = (std::copysign(kHalf, ray[i]) - from[i]) / ray[i];
    if (!(length < hit.length)) continue;
    hit.length = length;
    axis = i;
  }
  hit.wall = 2 * axis + (ray[axis] > 0 ? 1 : 0);
  const Eigen::Vector3d point = from + hit.length * ray;
  const double scale = (kPaintSize - 2) / (2 * kHalf);
  hit.paint = {(point[(axis + 1) % 3] + kHalf) * scale, (point[(axis + 2) % 3] + kHalf) * scale};
  return hit;
}

std::shared_ptr<SensorInfo> sensor_of(const Camera& color, const Camera& depth) {
  auto sensor = std::make_shared<SensorInfo>();
  sensor->color_camera = color;
  sensor->depth_camera = depth;
  return sensor;
}

}  // namespace

std::shared_ptr<const SensorInfo> registered_sensor() {
  const Camera camera = pinhole(320, 240, 262, 262, 159.5, 119.5);
  return sensor_of(camera, camera);
}

std::shared_ptr<const SensorInfo> unregistered_sensor() {
  auto sensor =
      sensor_of(pinhole(320, 240, 262, 262, 159.5, 119.5), pinhole(320, 240, 292, 292, 160, 118));
  sensor->color_from_depth = Pose(so3_exp({0.01, 0.02, 0.0075}), {-0.022, 0.001, 0});
  sensor->registered = false;
  return sensor;
}

PaintedRoom::PaintedRoom(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (cv::Mat& wall : walls_) wall = painting(random);
}

FramePtr PaintedRoom::frame(const std::shared_ptr<const SensorInfo>& sensor,
                            const Pose& world_from_camera, std::int64_t index) const {
  const auto each_pixel = [](const Camera& camera, const Pose& world_from, const auto& visit) {
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const Eigen::Vector3d ray = unproject(camera, Eigen::Vector2d(x, y));
        visit(x, y, leave(world_from.translation(), world_from.rotation() * ray));
      }
    }
  };
  auto frame = std::make_shared<Frame>();
  frame->index = index;
  frame->sensor = sensor;
  frame->world_from_camera = world_from_camera;
  const Camera& depth = *sensor->depth_camera;
  const Camera& color = *sensor->color_camera;
  frame->depth.create(depth.height, depth.width, CV_32FC1);
  each_pixel(depth, world_from_camera, [&](int x, int y, const Hit& hit) {
    frame->depth.at<float>(y, x) = static_cast<float>(hit.length);  // the ray's z is one
  });
  frame->color.create(color.height, color.width, CV_8UC1);
  each_pixel(color, world_from_camera * sensor->color_from_depth.inverse(),
             [&](int x, int y, const Hit& hit) {
               cv::Mat sample;
               cv::getRectSubPix(walls_[hit.wall], {1, 1}, hit.paint, sample);
               frame->color.at<std::uint8_t>(y, x) = sample.at<std::uint8_t>(0);
             });
  return frame;
}

TrackedFrame tracked(const FramePtr& frame, TrackingState state) {
  TrackedFrame result;
  result.frame = frame;
  result.world_from_camera = *frame->world_from_camera;
  result.state = state;
  return result;
}

Pose at(double x, double angle) { return Pose(so3_exp({0, angle, 0}), {x, 0, 0}); }

}  // namespace armsreach::test
