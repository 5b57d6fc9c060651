// The mapped surface as a PLY file, binary little-endian: vertices with position [m, world], normal
// and grey as red, green, blue; faces where there are any, else it is a point cloud.
#pragma once

#include <ostream>

#include "vision/mapping/mesh.hpp"

namespace armsreach::mapping {

// False in the stream's state tells that writing failed.
void write_ply(std::ostream& out, const SurfaceMesh& mesh);

}  // namespace armsreach::mapping
