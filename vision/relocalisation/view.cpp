#include "vision/relocalisation/view.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vision/core/pyramid.hpp"
#include "vision/core/registration.hpp"
#include "vision/relocalisation/three_point.hpp"

namespace armsreach::relocalisation {
namespace {

constexpr int kFeatureWidth = 320;  // px; features.hpp says why
constexpr int kSmallerBy = 4;       // of the depth image that is kept

cv::Mat grey_of(const cv::Mat& image, cv::Size size) {
  cv::Mat grey = image;
  if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  if (grey.size() == size) return grey;
  cv::Mat reduced;
  cv::resize(grey, reduced, size, 0, 0, cv::INTER_AREA);
  return reduced;
}

// The camera of an image reduced by a factor, the remainder at the far edges cut off.
Camera reduced_camera(Camera camera, int factor) {
  camera.width -= camera.width % factor;
  camera.height -= camera.height % factor;
  return resized(camera, camera.width / factor, camera.height / factor);
}

// The frame's depth as the colour camera sees it, in an image of the given camera.
cv::Mat depth_in_color(const Frame& frame, const Camera& color) {
  const SensorInfo& sensor = *frame.sensor;
  if (frame.depth.empty() || !sensor.depth_camera) return {};
  const int factor = std::max(frame.depth.cols / color.width, 1);
  const cv::Mat depth = reduced_depth(frame.depth, factor);
  if (sensor.registered && depth.cols == color.width && depth.rows == color.height) return depth;
  return registered_depth(depth, reduced_camera(*sensor.depth_camera, factor), color,
                          sensor.color_from_depth);
}

// Whether enough is known to judge a pose by.
bool telling(const cv::Mat& depth) {
  constexpr int kShare = 20;  // one pixel in so many
  return cv::countNonZero(depth > 0) * kShare > static_cast<int>(depth.total());
}

void compare(const View& from, const View& to, const Pose& to_from_from, DepthAgreement& sum) {
  for (int y = 0; y < from.depth.rows; ++y) {
    for (int x = 0; x < from.depth.cols; ++x) {
      const float z = from.depth.at<float>(y, x);
      if (!(z > 0)) continue;
      const Eigen::Vector3d point =
          to_from_from * (static_cast<double>(z) * unproject(from.camera, Eigen::Vector2d(x, y)));
      const auto pixel = project(to.camera, point);
      if (!pixel || !to.camera.contains(*pixel)) continue;
      const double seen = static_cast<double>(to.depth.at<float>(
          static_cast<int>(std::lround(pixel->y())), static_cast<int>(std::lround(pixel->x()))));
      if (!(seen > 0)) continue;
      const double behind = point.z() - seen;
      const double tolerance = depth_tolerance(seen);
      ++(std::abs(behind) < tolerance ? sum.agreeing : behind > 0 ? sum.hidden : sum.contradicting);
    }
  }
}

}  // namespace

std::optional<View> view_of(const Frame& frame, int most_features) {
  if (frame.color.empty()) return std::nullopt;
  const SensorInfo& sensor = *frame.sensor;
  const Camera& full = sensor.color_camera ? *sensor.color_camera : sensor.camera();
  const int height = std::max(cvRound(kFeatureWidth * frame.color.rows / frame.color.cols), 1);
  const Camera color = resized(full, kFeatureWidth, height);
  const cv::Mat depth = depth_in_color(frame, color);
  View view;
  view.features =
      find_features(grey_of(frame.color, {color.width, color.height}), depth, color, most_features);
  view.pixel_size = 1 / color.fx;
  view.camera = reduced_camera(color, kSmallerBy);
  if (!depth.empty() && telling(depth)) view.depth = reduced_depth(depth, kSmallerBy);
  return view;
}

Pose color_from_camera(const SensorInfo& sensor) {
  return sensor.depth_camera && !sensor.registered ? sensor.color_from_depth : Pose();
}

DepthAgreement depth_agreement(const View& a, const View& b, const Pose& b_from_a) {
  DepthAgreement sum;
  if (a.depth.empty() || b.depth.empty()) return sum;
  compare(a, b, b_from_a, sum);
  compare(b, a, b_from_a.inverse(), sum);
  return sum;
}

}  // namespace armsreach::relocalisation
