// Maps as OctoMap ColorOcTree files (.ot): log-odds and intensity (grey in all three channels) of
// every voxel that was seen; stock OctoMap opens them. Source of the format: OctoMap 1.9,
// AbstractOcTree.cpp, OccupancyOcTreeBase and ColorOcTreeNode.
//
// After the tree, where OctoMap stops reading, follow the signed distances, so that a saved map
// continues exactly as it was. A file without them (anybody's .ot) is read too: its distances are
// estimated from the occupancy until new frames replace them.
#pragma once

#include <istream>
#include <ostream>
#include <string>

#include "vision/core/result.hpp"
#include "vision/mapping/voxel_map.hpp"

namespace armsreach::mapping {

// False in the stream's state tells that writing failed.
void write_octree(std::ostream& out, const VoxelGrid& grid);

// `where` names the stream in errors. The file's resolution replaces that of `options`. Wrong ids,
// truncated or inconsistent data and trees beyond options.max_blocks are errors.
Result<VoxelMap> read_octree(std::istream& in, const std::string& where,
                             const VoxelMapOptions& options);

}  // namespace armsreach::mapping
