#include "devices/kinect_model.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

namespace armsreach {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kColorFocalLength = 525;  // px, that of the open drivers; real ones have 515-530
constexpr int kNumbers = 2048;             // 11 bits
constexpr double kFarthest = 10;           // m, as far as the drivers go
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// A depth number counts shifts in quarter pixels of the reference image (1280 to the width) from
// that of the reference plane; the remainder is the correlation window's offset. These are
// libfreenect's (const_shift, parameter_coefficient), the same in every Kinect.
constexpr double kReferenceNumber = 800;
constexpr double kNumbersPerPixel = 4;
constexpr double kWindowOffset = 0.375;  // px

template <class Meaning>
cv::Mat mapped(const void* numbers, Meaning meaning) {
  cv::Mat depth(kHeight, kWidth, CV_32F);
  const auto* in = static_cast<const std::uint8_t*>(numbers);
  auto* out = depth.ptr<float>();
  for (int i = 0; i < kWidth * kHeight; ++i) {
    std::uint16_t number;
    std::memcpy(&number, in + 2 * i, sizeof number);
    out[i] = meaning(number);
  }
  return depth;
}

}  // namespace

Camera kinect_depth_camera(const KinectGeometry& geometry) {
  const double focal_length = 0.5 * geometry.reference_distance / geometry.reference_pixel;
  Camera camera =
      pinhole(kWidth, kHeight, focal_length, focal_length, 0.5 * (kWidth - 1), 0.5 * (kHeight - 1));
  camera.name = "kinect-depth";
  return camera;
}

Camera kinect_color_camera() {
  Camera camera = pinhole(kWidth, kHeight, kColorFocalLength, kColorFocalLength, 0.5 * (kWidth - 1),
                          0.5 * (kHeight - 1));
  camera.name = "kinect-color";
  return camera;
}

SensorInfo registered_kinect() {
  SensorInfo sensor;
  sensor.color_camera = kinect_color_camera();
  sensor.depth_camera = kinect_color_camera();
  return sensor;
}

SensorInfo unregistered_kinect(const KinectGeometry& geometry) {
  SensorInfo sensor;
  sensor.color_camera = kinect_color_camera();
  sensor.depth_camera = kinect_depth_camera(geometry);
  sensor.registered = false;
  // Seen from behind, the colour camera sits to the right of the infra-red one.
  sensor.color_from_depth =
      Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-geometry.color_distance, 0, 0));
  return sensor;
}

float kinect_depth(int number, const KinectGeometry& geometry) {
  if (number < 0 || number >= kNumbers - 1) return kUnknown;
  const double pixels = (number - kReferenceNumber) / kNumbersPerPixel - kWindowOffset;
  const double shift = pixels * geometry.reference_pixel;  // m on the reference plane
  // Similar triangles over the baseline; a shift as long as it belongs to infinity.
  const double z =
      geometry.reference_distance * geometry.emitter_distance / (geometry.emitter_distance - shift);
  return z > 0 && z <= kFarthest ? static_cast<float>(z) : kUnknown;
}

cv::Mat depth_from_numbers(const void* numbers, const KinectGeometry& geometry) {
  std::array<float, kNumbers> table;
  for (int number = 0; number < kNumbers; ++number) {
    table[static_cast<std::size_t>(number)] = kinect_depth(number, geometry);
  }
  return mapped(numbers,
                [&](std::uint16_t number) { return number < kNumbers ? table[number] : kUnknown; });
}

cv::Mat depth_from_millimetres(const void* millimetres) {
  return mapped(millimetres, [](std::uint16_t mm) {
    return mm == 0 ? kUnknown : 0.001F * static_cast<float>(mm);
  });
}

}  // namespace armsreach
