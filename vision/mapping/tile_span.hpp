// Which tiles of an image a sphere may project into.
#pragma once

#include <algorithm>
#include <utility>

#include <Eigen/Core>

#include "vision/core/camera.hpp"

namespace armsreach::mapping {

struct TileSpan {
  int left, right;  // inclusive; empty when left > right
  int top, bottom;
};

// Along one axis: first and last tile that the interval `across` +- `radius`, anywhere between the
// depths `nearest` and `farthest`, may project into.
inline std::pair<int, int> tiles_of(float across, float radius, float nearest, float farthest,
                                    double focal, double middle, int tile, int count) {
  const auto size = static_cast<float>(tile);
  const float scale = static_cast<float>(focal) / size;
  const float axis = (static_cast<float>(middle) + 0.5F) / size;
  const float low = across - radius;
  const float high = across + radius;
  const float first = axis + scale * low / (low < 0 ? nearest : farthest);
  const float last = axis + scale * high / (high > 0 ? nearest : farthest);
  return {static_cast<int>(std::clamp(first, 0.0F, static_cast<float>(count))),
          static_cast<int>(std::clamp(last, -1.0F, static_cast<float>(count - 1)))};
}

// For a sphere wholly in front of the camera (centre.z > radius).
inline TileSpan tiles_of_sphere(const Camera& camera, int tile, int columns, int rows,
                                const Eigen::Vector3f& centre, float radius) {
  const float nearest = centre.z() - radius;
  const float farthest = centre.z() + radius;
  const auto [left, right] =
      tiles_of(centre.x(), radius, nearest, farthest, camera.fx, camera.cx, tile, columns);
  const auto [top, bottom] =
      tiles_of(centre.y(), radius, nearest, farthest, camera.fy, camera.cy, tile, rows);
  return {left, right, top, bottom};
}

}  // namespace armsreach::mapping
