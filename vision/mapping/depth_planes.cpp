#include "vision/mapping/depth_planes.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::mapping {
namespace {

// A surface slanted by more than this [tan of the angle to the viewing ray's normal, 77 deg] cannot
// be told from a depth edge.
constexpr float kSteepest = 4.4F;
// One-sided slopes that differ by less than this part of the value belong to one smooth surface.
constexpr float kSmooth = 0.02F;

// Slope, per `step` samples, of inverse depth at a sample between its two neighbours (0: unknown).
// Inverse depth is linear on planes. At an edge the smaller one-sided slope is the surface's own.
float slope(float before, float here, float after, float steepest) {
  const float left = here - before;
  const float right = after - here;
  const bool has_left = before > 0 && std::abs(left) < steepest * here;
  const bool has_right = after > 0 && std::abs(right) < steepest * here;
  if (has_left && has_right) {
    if (std::abs(left - right) < kSmooth * here) return (left + right) / 2;
    return std::abs(left) < std::abs(right) ? left : right;
  }
  return has_left ? left : has_right ? right : 0;
}

cv::Mat inverse_depth(const cv::Mat& depth, float max_range) {
  cv::Mat inverse(depth.size(), CV_32FC1);
  for (int v = 0; v < depth.rows; ++v) {
    const float* d = depth.ptr<float>(v);
    float* out = inverse.ptr<float>(v);
    for (int u = 0; u < depth.cols; ++u) out[u] = d[u] > 0 && d[u] < max_range ? 1 / d[u] : 0;
  }
  return inverse;
}

}  // namespace

DepthPlanes depth_planes(const cv::Mat& depth, const cv::Mat& weights, double min_trust,
                         const Camera& camera, double max_range, double unit) {
  CV_Assert(depth.type() == CV_32FC1 && depth.cols == camera.width && depth.rows == camera.height);
  CV_Assert(weights.empty() || (weights.type() == CV_32FC1 && weights.size() == depth.size()));
  const cv::Mat inverse = inverse_depth(depth, static_cast<float>(max_range));
  DepthPlanes out;
  out.width = depth.cols;
  out.height = depth.rows;
  out.planes.resize(depth.total() + 1);

  const int step = std::max(1, depth.cols / 160);  // slopes over as much surface at any resolution
  const float fx = static_cast<float>(camera.fx) / static_cast<float>(step);
  const float fy = static_cast<float>(camera.fy) / static_cast<float>(step);
  const float scale = static_cast<float>(1 / unit);
  for (int v = 0; v < depth.rows; ++v) {
    const float* here = inverse.ptr<float>(v);
    const float* above = v >= step ? inverse.ptr<float>(v - step) : nullptr;
    const float* below = v + step < depth.rows ? inverse.ptr<float>(v + step) : nullptr;
    const float* weight = weights.empty() ? nullptr : weights.ptr<float>(v);
    const float y = static_cast<float>((v - camera.cy) / camera.fy);
    PixelPlane* line = &out.planes[static_cast<std::size_t>(v) * out.width];
    for (int u = 0; u < depth.cols; ++u) {
      const float w = here[u];
      if (w == 0) continue;
      // 1/z = a x + b y + c in normalised image coordinates, so (a, b, c) . p = 1 on the plane.
      const float a = fx * slope(u >= step ? here[u - step] : 0, w,
                                 u + step < depth.cols ? here[u + step] : 0, kSteepest / fx);
      const float b = fy * slope(above ? above[u] : 0, w, below ? below[u] : 0, kSteepest / fy);
      const float x = static_cast<float>((u - camera.cx) / camera.fx);
      const float c = w - a * x - b * y;
      const float distance = 1 / std::sqrt(a * a + b * b + c * c);
      const bool trusted = !(weight && weight[u] < static_cast<float>(min_trust));
      line[u] = {a * distance, b * distance, c * distance, (trusted ? scale : -scale) * distance};
    }
  }
  return out;
}

}  // namespace armsreach::mapping
