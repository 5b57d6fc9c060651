// The inner loop of insertion: one frame's evidence into one block.
#pragma once

#include <cstdint>

#include "vision/mapping/block.hpp"
#include "vision/mapping/pixel_plane.hpp"

namespace armsreach::mapping {

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
  float step[3][3] = {};    // one voxel along the world's x, y, z
  float corner[3][8] = {};  // x, y, z of a 2x2x2 cube's voxels from its first
  float cube[64][3] = {};   // of a block's cubes' first voxels from the block's first
  float cube_near = 0;      // least and greatest of corner[2]
  float cube_far = 0;
  float voxel = 0;  // m
  float noise = 0;  // sigma = noise * depth^2, in voxel edges

  const std::int16_t* hits = nullptr;  // HitTable

  std::int16_t free = 0;  // log-odds of what lies in front, and the clamps of their sum
  std::int16_t lowest = 0;
  std::int16_t highest = 0;
  std::int16_t occupied_above = 0;
  float max_weight = 0;
  float intensity_rate = 0;  // least share of a new intensity
  // false: the voxels in the band d +- (3 sigma + 3 s). true: the known voxels in front of it,
  // where nothing can be any more.
  bool carve = false;
};

// Along z in the camera's frame, in voxel edges; empty when near > far.
struct DepthInterval {
  float near = 0;
  float far = 0;
};

// One for each octant of a block, 4x4x4 voxels, x fastest.
struct DepthIntervals {
  DepthInterval octant[8];
};

// `origin` is the centre of the block's voxel (0,0,0); voxels outside `depths` are not
// looked at. False when the frame says nothing about the block, which is then untouched.
bool update_block(Block& block, const float (&origin)[3], const DepthIntervals& depths,
                  const FrameEvidence& frame);

}  // namespace armsreach::mapping
