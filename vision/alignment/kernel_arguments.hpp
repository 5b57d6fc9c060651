// What the aligner's kernels are given, from the types of the house. Implementation detail.
#pragma once

#include "vision/alignment/align_kernels.hpp"
#include "vision/alignment/level.hpp"
#include "vision/core/pose.hpp"

namespace armsreach {

Planes planes(const Level& level);  // valid as long as the level is neither changed nor moved
Warp warp_from(const Pose& target_from_source, double intensity_offset);

}  // namespace armsreach
