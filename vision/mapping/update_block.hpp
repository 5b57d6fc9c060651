// The inner loop of insertion: one frame's evidence into one block.
#pragma once

#include <cstdint>

#include "vision/mapping/block.hpp"
#include "vision/mapping/pixel_plane.hpp"

namespace armsreach::mapping {

// Along z in the camera's frame, in voxel edges; empty when near > far.
struct DepthInterval {
  float near = 0;
  float far = 0;
};

// A frame as the inner loop wants it. Lengths are in voxel edges, directions in the camera's frame.
struct FrameEvidence {
  const PixelPlane* planes = nullptr;  // width * height, then one unknown
  const float* intensity = nullptr;    // width * height, NaN unknown; or null
  int width = 0;
  int height = 0;
  float fx = 0;
  float fy = 0;
  float cx = 0;
  float cy = 0;
  float step[3][3] = {};     // one voxel along the world's x, y, z
  float corner[3][8] = {};   // x, y, z of a 2x2x2 cube's voxels from its first
  float cube[64][3] = {};    // of a block's cubes' first voxels from the block's first
  float centre[3][64] = {};  // of a block's cubes' centres from the block's first voxel
  float half_depth = 0;      // of a cube's voxels about its centre, along z
  float voxel = 0;           // m
  float noise = 0;           // sigma = noise * depth^2, in voxel edges

  const std::int16_t* hits = nullptr;  // HitTable

  std::int16_t free = 0;  // log-odds of what lies in front, and the clamps of their sum
  std::int16_t lowest = 0;
  std::int16_t highest = 0;
  float max_weight = 0;
  float intensity_rate = 0;  // least share of a new intensity
  // false: the voxels in the band d +- (3 sigma + 3 s). true: the known voxels in front of it,
  // where nothing can be any more.
  bool carve = false;

  // Tiles of the image, with a border of one around it, row by row: the depths that matter to a
  // cube whose centre projects there. Tile coordinates are fx x / z + cx.
  const DepthInterval* tiles = nullptr;
  int tile_columns = 0;
  int tile_rows = 0;
  float tile_fx = 0;
  float tile_fy = 0;
  float tile_cx = 0;
  float tile_cy = 0;
  float tiles_from = 0;    // depth from which tiles are wide enough for that
  DepthInterval anywhere;  // what matters to nearer cubes
};

// The cubes of a block, a bit each, that the frame may say something about. `origin` is the centre
// of the block's voxel (0,0,0).
std::uint64_t cubes_in_reach(const float (&origin)[3], const FrameEvidence& frame);

using BlockCubes = VoxelCube[kBlockVoxels / 8];

// Looks at these cubes of a block. Returns those that the frame changes; what they become is in
// their places in `updated`.
std::uint64_t update_cubes(const Block& block, const float (&origin)[3], std::uint64_t cubes,
                           const FrameEvidence& frame, BlockCubes& updated);

}  // namespace armsreach::mapping
