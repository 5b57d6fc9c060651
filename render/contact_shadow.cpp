#include "render/contact_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

namespace armsreach::render {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int kTexels = 128;

struct Bounds {
  Vector3f low = Vector3f::Constant(std::numeric_limits<float>::max());
  Vector3f high = Vector3f::Constant(std::numeric_limits<float>::lowest());
};

Bounds bounds_of(const Mesh& mesh) {
  Bounds bounds;
  for (const Vertex& vertex : mesh.vertices) {
    bounds.low = bounds.low.cwiseMin(vertex.position);
    bounds.high = bounds.high.cwiseMax(vertex.position);
  }
  return bounds;
}

float cross(const Vector2f& a, const Vector2f& b) { return a.x() * b.y() - a.y() * b.x(); }

// Lowers the height map to a triangle given in texels, z in metres.
void lower_to(cv::Mat& height, const Vector3f& a, const Vector3f& b, const Vector3f& c) {
  const Vector2f ab = (b - a).head<2>();
  const Vector2f ac = (c - a).head<2>();
  const float area = cross(ab, ac);
  if (std::abs(area) < 1e-6F) return;
  const auto first = [](float x) { return std::max(0, static_cast<int>(std::ceil(x))); };
  const auto last = [](float x) { return std::min(kTexels - 1, static_cast<int>(std::floor(x))); };
  for (int y = first(std::min({a.y(), b.y(), c.y()})); y <= last(std::max({a.y(), b.y(), c.y()}));
       ++y) {
    for (int x = first(std::min({a.x(), b.x(), c.x()})); x <= last(std::max({a.x(), b.x(), c.x()}));
         ++x) {
      const Vector2f ap = Vector2f(static_cast<float>(x), static_cast<float>(y)) - a.head<2>();
      const float s = cross(ap, ac) / area;
      const float t = cross(ab, ap) / area;
      if (s < 0 || t < 0 || s + t > 1) continue;
      float& lowest = height.at<float>(y, x);
      lowest = std::min(lowest, a.z() + s * (b.z() - a.z()) + t * (c.z() - a.z()));
    }
  }
}

// How much light a surface at this height takes from the plane, blurred as its penumbra is.
cv::Mat blurred_weight(const cv::Mat& height, float reach, double blur_texels) {
  cv::Mat weight(height.size(), CV_32F);
  std::transform(height.begin<float>(), height.end<float>(), weight.begin<float>(),
                 [reach](float h) { return std::exp(-std::max(h, 0.F) / reach); });
  cv::GaussianBlur(weight, weight, {}, blur_texels);
  return weight;
}

}  // namespace

ContactShadow bake_contact_shadow(const Mesh& mesh) {
  const Bounds bounds = bounds_of(mesh);
  const Vector3f size = bounds.high - bounds.low;
  // The wide part fades over two fifths of the thing's height; the margin holds its whole blur.
  const float reach = 0.4F * size.z();
  const float blur = 0.35F * reach;
  const float margin = 3 * blur;
  const Vector2f corner(bounds.low.x() - margin, bounds.low.y() - margin);
  const Vector2f extent(size.x() + 2 * margin, size.y() + 2 * margin);
  const Vector2f texels_per_metre(kTexels / extent.x(), kTexels / extent.y());

  cv::Mat height(kTexels, kTexels, CV_32F, cv::Scalar(1e3));
  const auto in_texels = [&](std::uint32_t index) {
    const Vector3f& p = mesh.vertices[index].position;
    return Vector3f((p.x() - corner.x()) * texels_per_metre.x() - 0.5F,
                    (p.y() - corner.y()) * texels_per_metre.y() - 0.5F, p.z());
  };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    lower_to(height, in_texels(mesh.indices[i]), in_texels(mesh.indices[i + 1]),
             in_texels(mesh.indices[i + 2]));

  const double texels = 0.5 * static_cast<double>(texels_per_metre.x() + texels_per_metre.y());
  const double wide_blur = static_cast<double>(blur) * texels;
  // What hangs high still takes the light from above; what nearly touches takes all.
  const cv::Mat overhead = blurred_weight(height, 3 * size.z(), wide_blur);
  const cv::Mat near = blurred_weight(height, reach, 0.6 * wide_blur);
  const cv::Mat contact = blurred_weight(height, 0.06F * size.z(), 0.15 * wide_blur);
  const cv::Mat lit = (1 - 0.36 * overhead).mul(1 - 0.3 * near).mul(1 - 0.5 * contact);
  ContactShadow shadow;
  const cv::Mat darkness = 1 - lit;
  darkness.convertTo(shadow.darkness, CV_8U, 255);
  shadow.footprint = {corner.x(), corner.y(), extent.x(), extent.y()};
  return shadow;
}

}  // namespace armsreach::render
