// Read-only face that the live map and its snapshots share.
#pragma once

#include <cstdint>

#include "vision/mapping/block_table.hpp"

namespace armsreach::mapping {

struct VoxelGrid {
  double resolution = 0.01;         // edge of a voxel, m
  std::int16_t occupied_above = 0;  // log-odds in kLogOddsUnit
  BlockTable blocks;
};

}  // namespace armsreach::mapping
