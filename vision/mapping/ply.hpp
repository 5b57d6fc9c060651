// The mapped surface as a PLY point cloud: position [m, world], normal and grey as red, green,
// blue; binary little-endian.
#pragma once

#include <ostream>

#include "vision/mapping/voxel_grid.hpp"

namespace armsreach::mapping {

// False in the stream's state tells that writing failed.
void write_ply(std::ostream& out, const VoxelGrid& grid);

}  // namespace armsreach::mapping
