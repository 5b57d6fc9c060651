#include "vision/mapping/ply.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "vision/mapping/byte_stream.hpp"
#include "vision/mapping/surface.hpp"

namespace armsreach::mapping {

void write_ply(std::ostream& out, const VoxelGrid& grid) {
  std::vector<SurfacePoint> points;
  for (const BlockKey& key : grid.blocks.keys()) {
    const std::vector<SurfacePoint> found = surface_points(grid, key);
    points.insert(points.end(), found.begin(), found.end());
  }
  out << "ply\nformat binary_little_endian 1.0\ncomment Armsreach map\nelement vertex "
      << points.size() << '\n';
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
    out << "property float " << name << '\n';
  }
  for (const char* name : {"red", "green", "blue"}) out << "property uchar " << name << '\n';
  out << "end_header\n";
  for (const SurfacePoint& point : points) {
    for (const float value : point.point_in_world) write_value(out, value);
    for (const float value : point.normal_in_world) write_value(out, value);
    const auto grey = static_cast<std::uint8_t>(std::lround(point.intensity * 255));
    for (int channel = 0; channel < 3; ++channel) write_value(out, grey);
  }
}

}  // namespace armsreach::mapping
