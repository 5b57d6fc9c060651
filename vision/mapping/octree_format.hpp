// Constants of the .ot format that reading and writing share.
#pragma once

namespace armsreach::mapping::octree {

inline constexpr const char* kFirstLine = "# Octomap OcTree file";
inline constexpr const char* kDistancesTag = "armsreach signed distances 1";
inline constexpr int kDepth = 16;  // levels below the root
inline constexpr int kKeyOffset = 32768;

}  // namespace armsreach::mapping::octree
