// Signed distances for a map that has occupancy alone.
#pragma once

#include "vision/mapping/voxel_map.hpp"

namespace armsreach::mapping {

// Near each occupied voxel: the distance from the plane through the centroid of the occupied voxels
// around, square to the direction in which free space lies. Good to a fraction of a voxel, and with
// so small a weight that the first frames replace it.
void estimate_distances(VoxelMap& map);

}  // namespace armsreach::mapping
