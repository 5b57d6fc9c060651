#include "vision/core/camera_stream.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace armsreach {
namespace {

constexpr std::int32_t kLargest = 1 << 14;  // px, of a picture
constexpr double kFarthest = 1e5;           // px: what no lens has

bool possible(const Camera& camera, std::int32_t distortion) {
  const auto size = [](int pixels) { return pixels > 0 && pixels <= kLargest; };
  const auto focal = [](double pixels) { return pixels > 0 && pixels < kFarthest; };
  return size(camera.width) && size(camera.height) && distortion >= 0 &&
         distortion <= static_cast<std::int32_t>(Distortion::monoslam) && focal(camera.fx) &&
         focal(camera.fy) && std::abs(camera.cx) < kFarthest && std::abs(camera.cy) < kFarthest &&
         std::all_of(camera.coefficients.begin(), camera.coefficients.end(),
                     [](double value) { return std::isfinite(value); });
}

}  // namespace

void write_camera(std::ostream& out, const Camera& camera) {
  write_value(out, std::int32_t{camera.width});
  write_value(out, std::int32_t{camera.height});
  write_value(out, static_cast<std::int32_t>(camera.distortion));
  for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy}) write_value(out, value);
  write_values(out, camera.coefficients);
}

std::optional<Camera> read_camera(ValueReader& in) {
  Camera camera;
  camera.width = in.get<std::int32_t>();
  camera.height = in.get<std::int32_t>();
  const auto distortion = in.get<std::int32_t>();
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value = in.get<double>();
  camera.coefficients = in.get_values<decltype(camera.coefficients)>();
  if (!possible(camera, distortion)) return std::nullopt;
  camera.distortion = static_cast<Distortion>(distortion);
  return camera;
}

}  // namespace armsreach
