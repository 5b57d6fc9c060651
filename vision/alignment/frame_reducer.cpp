#include "vision/alignment/frame_reducer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "vision/alignment/registration_kernels.hpp"

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

RegistrationKernels registration_kernels(Isa isa) {
#ifdef __x86_64__
  if (isa == Isa::v4) return v4::kRegistrationKernels;
  if (isa == Isa::v3) return v3::kRegistrationKernels;
#endif
  static_cast<void>(isa);
  return baseline::kRegistrationKernels;
}

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
  out.map_x = cv::Mat(distorted.height, distorted.width, CV_32FC1,
                      cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
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

ReducedFrame FrameReducer::reduce(const Frame& frame, double depth_noise) const {
  ReducedFrame reduced;
  const auto fits = [](const cv::Mat& image, const std::optional<Camera>& camera) {
    return camera && image.size() == cv::Size(camera->width, camera->height);
  };
  if (fits(frame.depth, sensor_->depth_camera)) {
    reduced.depth = reduced_depth(frame.depth, depth_.factor, depth_noise);
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
  const auto to_float = [](double value) { return static_cast<float>(value); };
  const Camera& color = color_.camera;
  const RegistrationImage image{intensity.ptr<float>(), intensity.cols,
                                intensity.rows,         static_cast<int>(intensity.step1()),
                                to_float(color.fx),     to_float(color.fy),
                                to_float(color.cx),     to_float(color.cy)};
  RegistrationRow row{};
  row.width = depth.cols;
  row.first_x = to_float(-camera_.cx / camera_.fx);
  row.x_per_pixel = to_float(1 / camera_.fx);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) row.rotation[i][j] = rotation(i, j);
    row.translation[i] = translation(i);
  }
  const RegistrationKernels kernels = registration_kernels(best_isa());
  cv::Mat out(depth.size(), CV_32FC1);
  for (int i = 0; i < depth.rows; ++i) {
    row.depth = depth.ptr<float>(i);
    row.y = to_float((i - camera_.cy) / camera_.fy);
    kernels.look_up_row(row, image, out.ptr<float>(i));
  }
  return out;
}

}  // namespace armsreach
