#include "vision/mapping/ply.hpp"

#include <cmath>
#include <cstdint>

#include "vision/core/byte_stream.hpp"

namespace armsreach::mapping {

void write_ply(std::ostream& out, const SurfaceMesh& mesh) {
  out << "ply\nformat binary_little_endian 1.0\ncomment Armsreach map\nelement vertex "
      << mesh.vertices.size() << '\n';
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
    out << "property float " << name << '\n';
  }
  for (const char* name : {"red", "green", "blue"}) out << "property uchar " << name << '\n';
  if (!mesh.triangles.empty()) {
    out << "element face " << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\n";
  }
  out << "end_header\n";
  for (const SurfacePoint& point : mesh.vertices) {
    write_values(out, point.point_in_world);
    write_values(out, point.normal_in_world);
    const auto grey = static_cast<std::uint8_t>(std::lround(point.intensity * 255));
    for (int channel = 0; channel < 3; ++channel) write_value(out, grey);
  }
  for (const Triangle& triangle : mesh.triangles) {
    write_value(out, static_cast<std::uint8_t>(triangle.size()));
    for (const std::uint32_t vertex : triangle) {
      write_value(out, static_cast<std::int32_t>(vertex));
    }
  }
}

}  // namespace armsreach::mapping
