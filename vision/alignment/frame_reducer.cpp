#include "vision/alignment/frame_reducer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "vision/core/pyramid.hpp"

namespace armsreach {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kSameSurface = 1.03F;

struct Cell {
  const float* upper;  // its two upper samples
  const float* lower;
  float x, y;  // position in it, 0..1
};

float mean(const Cell& cell) {
  const float upper = cell.upper[0] + cell.x * (cell.upper[1] - cell.upper[0]);
  const float lower = cell.lower[0] + cell.x * (cell.lower[1] - cell.lower[0]);
  return upper + cell.y * (lower - upper);
}

float nearest(const Cell& cell) {
  return (cell.y < 0.5F ? cell.upper : cell.lower)[cell.x < 0.5F ? 0 : 1];
}

// Calls value(cell) for the pixel (u, v) of an image, NaN outside.
template <class Value>
float look_up(const cv::Mat& image, float u, float v, Value value) {
  const float last_u = static_cast<float>(image.cols - 1);
  const float last_v = static_cast<float>(image.rows - 1);
  if (!(u >= 0 && v >= 0 && u <= last_u && v <= last_v)) return kUnknown;
  const int col = std::min(static_cast<int>(u), image.cols - 2);
  const int row = std::min(static_cast<int>(v), image.rows - 2);
  return value(Cell{image.ptr<float>(row) + col, image.ptr<float>(row + 1) + col,
                    u - static_cast<float>(col), v - static_cast<float>(row)});
}

template <class Value>
cv::Mat remapped(const cv::Mat& image, const cv::Mat& map_x, const cv::Mat& map_y, Value value) {
  cv::Mat out(image.size(), CV_32FC1);
  for (int row = 0; row < out.rows; ++row) {
    for (int col = 0; col < out.cols; ++col) {
      out.at<float>(row, col) =
          look_up(image, map_x.at<float>(row, col), map_y.at<float>(row, col), value);
    }
  }
  return out;
}

// Between the four samples of one surface; across an edge or beside a hole the nearest sample.
float surface_value(const Cell& cell) {
  const float near = std::min({cell.upper[0], cell.upper[1], cell.lower[0], cell.lower[1]});
  const float far = std::max({cell.upper[0], cell.upper[1], cell.lower[0], cell.lower[1]});
  const float between = mean(cell);
  return between > 0 && far <= kSameSurface * near ? between : nearest(cell);
}

}  // namespace

FrameReducer::Reduction FrameReducer::reduction(const Camera& camera, int width) {
  Reduction out;
  out.factor =
      std::max(1, static_cast<int>(std::lround(static_cast<double>(camera.width) / width)));
  Camera whole_blocks = camera;
  whole_blocks.width -= camera.width % out.factor;
  whole_blocks.height -= camera.height % out.factor;
  const Camera distorted =
      resized(whole_blocks, camera.width / out.factor, camera.height / out.factor);
  out.camera = pinhole(distorted.width, distorted.height, distorted.fx, distorted.fy, distorted.cx,
                       distorted.cy);
  if (!distorted.has_distortion()) return out;
  out.map_x = cv::Mat(distorted.height, distorted.width, CV_32FC1, cv::Scalar(kUnknown));
  out.map_y = out.map_x.clone();
  for (int row = 0; row < distorted.height; ++row) {
    for (int col = 0; col < distorted.width; ++col) {
      const auto pixel = project(distorted, unproject(out.camera, Eigen::Vector2d(col, row)));
      if (!pixel) continue;
      out.map_x.at<float>(row, col) = static_cast<float>(pixel->x());
      out.map_y.at<float>(row, col) = static_cast<float>(pixel->y());
    }
  }
  return out;
}

FrameReducer::FrameReducer(std::shared_ptr<const SensorInfo> sensor, int width)
    : sensor_(std::move(sensor)) {
  if (sensor_->depth_camera) depth_ = reduction(*sensor_->depth_camera, width);
  if (sensor_->color_camera) color_ = reduction(*sensor_->color_camera, width);
  camera_ = sensor_->depth_camera ? depth_.camera : color_.camera;
}

ReducedFrame FrameReducer::reduce(const Frame& frame) const {
  ReducedFrame reduced;
  const auto fits = [](const cv::Mat& image, const std::optional<Camera>& camera) {
    return camera && image.size() == cv::Size(camera->width, camera->height);
  };
  if (fits(frame.depth, sensor_->depth_camera)) {
    reduced.depth = reduced_depth(frame.depth, depth_.factor);
    if (!depth_.map_x.empty()) {
      reduced.depth = remapped(reduced.depth, depth_.map_x, depth_.map_y, surface_value);
    }
  }
  if (fits(frame.color, sensor_->color_camera)) {
    reduced.intensity = reduced_intensity(frame.color, color_.factor);
    if (!color_.map_x.empty()) {
      reduced.intensity = remapped(reduced.intensity, color_.map_x, color_.map_y, mean);
    }
    if (!sensor_->registered && sensor_->depth_camera) {
      reduced.intensity =
          reduced.depth.empty() ? cv::Mat() : registered(reduced.intensity, reduced.depth);
    }
  }
  return reduced;
}

cv::Mat FrameReducer::registered(const cv::Mat& intensity, const cv::Mat& depth) const {
  const Eigen::Matrix3f rotation = sensor_->color_from_depth.rotation_matrix().cast<float>();
  const Eigen::Vector3f translation = sensor_->color_from_depth.translation().cast<float>();
  const auto fx = static_cast<float>(color_.camera.fx);
  const auto fy = static_cast<float>(color_.camera.fy);
  const auto cx = static_cast<float>(color_.camera.cx);
  const auto cy = static_cast<float>(color_.camera.cy);
  cv::Mat out(depth.size(), CV_32FC1);
  for (int row = 0; row < depth.rows; ++row) {
    const float* z = depth.ptr<float>(row);
    float* grey = out.ptr<float>(row);
    const float y =
        (static_cast<float>(row) - static_cast<float>(camera_.cy)) / static_cast<float>(camera_.fy);
    for (int col = 0; col < depth.cols; ++col) {
      const float x = (static_cast<float>(col) - static_cast<float>(camera_.cx)) /
                      static_cast<float>(camera_.fx);
      const Eigen::Vector3f point =
          rotation * Eigen::Vector3f(z[col] * x, z[col] * y, z[col]) + translation;
      grey[col] = point.z() > 0 ? look_up(intensity, fx * point.x() / point.z() + cx,
                                          fy * point.y() / point.z() + cy, mean)
                                : kUnknown;
    }
  }
  return out;
}

}  // namespace armsreach
