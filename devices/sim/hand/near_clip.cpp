#include "devices/sim/hand/near_clip.hpp"

#include <utility>

namespace armsreach::sim {
namespace {

using Eigen::Vector3f;

class NearClipper {
 public:
  NearClipper(std::span<const Vector3f> positions, std::span<const Vector3f> colors, float near)
      : positions_(positions), colors_(colors), near_(near) {}

  // Walks round the triangle: keeps corners before the plane, adds one where a side crosses it.
  void cut(const TriangleIndices& triangle) {
    const auto first = static_cast<std::uint32_t>(made_.positions.size());
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i];
      const std::uint32_t b = triangle[(i + 1) % 3];
      if (before(a)) add(a, a, 0);
      if (before(a) == before(b)) continue;
      add(a, b, (near_ - positions_[a].z()) / (positions_[b].z() - positions_[a].z()));
      made_.positions.back().z() = near_;
    }
    const auto end = static_cast<std::uint32_t>(made_.positions.size());
    for (std::uint32_t i = first + 2; i < end; ++i) made_.triangles.push_back({first, i - 1, i});
  }
  bool crosses(const TriangleIndices& triangle) const {
    const int count = before(triangle[0]) + before(triangle[1]) + before(triangle[2]);
    return count == 1 || count == 2;
  }
  ClippedTriangles take() { return std::move(made_); }

 private:
  bool before(std::uint32_t vertex) const { return positions_[vertex].z() >= near_; }
  void add(std::uint32_t a, std::uint32_t b, float share) {
    made_.positions.push_back(positions_[a] + share * (positions_[b] - positions_[a]));
    if (!colors_.empty()) made_.colors.push_back(colors_[a] + share * (colors_[b] - colors_[a]));
  }

  std::span<const Vector3f> positions_;
  std::span<const Vector3f> colors_;
  float near_;
  ClippedTriangles made_;
};

}  // namespace

ClippedTriangles cut_at_near_plane(std::span<const Vector3f> positions,
                                   std::span<const Vector3f> colors,
                                   std::span<const TriangleIndices> triangles, float near) {
  NearClipper clipper(positions, colors, near);
  for (const TriangleIndices& triangle : triangles) {
    if (clipper.crosses(triangle)) clipper.cut(triangle);
  }
  return clipper.take();
}

}  // namespace armsreach::sim
