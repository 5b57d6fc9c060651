// Compiled once a processor level, into the namespace ARMSREACH_KERNEL_LEVEL. Nothing with external
// linkage may be instantiated here: the linker would keep one level's copy for all.
#include <cstring>

#include "vision/mapping/sensor_model.hpp"
#include "vision/mapping/update_block.hpp"

namespace armsreach::mapping::ARMSREACH_KERNEL_LEVEL {
std::uint64_t cubes_in_reach(const float (&origin)[3], const FrameEvidence& frame);
std::uint64_t update_cubes(const Block& block, const float (&origin)[3], std::uint64_t cubes,
                           const FrameEvidence& frame, BlockCubes& updated);

namespace {

// Eight lanes, a 2x2x2 cube of voxels (vector extension of GCC and Clang).
using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));
using Quad = float __attribute__((vector_size(16)));
using Shorts = std::int16_t __attribute__((vector_size(16)));
using Words = std::uint16_t __attribute__((vector_size(16)));
constexpr int kLanes = 8;

struct Lanes {
  Floats x, y, z;  // of the voxels' centres
  Floats u, v;     // px, +0.5: the pixel is their integer part
  Ints inside;     // the image, as masks
};

struct Surface {
  Floats distance;  // from the voxel to its pixel's plane, positive in front
  Floats ahead;     // the same along z, on the voxel's ray: d - v_d
  Floats depth;     // d
  Floats sigma;     // of d
  Floats along;     // the voxel's component along the plane's normal
  Floats per_edge;  // cosine of the slant: an edge across the surface by its extent along z
  Ints known;
  Ints trusted;
};

template <class Mask>
inline bool any(const Mask& mask) {
  std::uint64_t words[4];
  std::memcpy(words, &mask, sizeof(words));
  return (words[0] | words[1] | words[2] | words[3]) != 0;
}

template <class Vector>
inline void load(Vector& out, const void* from) {
  std::memcpy(&out, from, sizeof(out));
}
template <class Vector>
inline void store(void* to, const Vector& from) {
  std::memcpy(to, &from, sizeof(from));
}

inline void least(Floats& a, const Floats& b) { a = b < a ? b : a; }
inline void most(Floats& a, const Floats& b) { a = b > a ? b : a; }

inline void square_root(Floats& a) {
  for (int i = 0; i < kLanes; ++i) a[i] = __builtin_sqrtf(a[i]);
}

// Eight records of four floats to four vectors of eight.
inline void transpose(const Quad (&r)[kLanes], Floats (&out)[4]) {
  const Floats a = __builtin_shufflevector(r[0], r[4], 0, 1, 2, 3, 4, 5, 6, 7);
  const Floats b = __builtin_shufflevector(r[1], r[5], 0, 1, 2, 3, 4, 5, 6, 7);
  const Floats c = __builtin_shufflevector(r[2], r[6], 0, 1, 2, 3, 4, 5, 6, 7);
  const Floats d = __builtin_shufflevector(r[3], r[7], 0, 1, 2, 3, 4, 5, 6, 7);
  const Floats ab_low = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  const Floats ab_high = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  const Floats cd_low = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
  const Floats cd_high = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
  out[0] = __builtin_shufflevector(ab_low, cd_low, 0, 1, 8, 9, 4, 5, 12, 13);
  out[1] = __builtin_shufflevector(ab_low, cd_low, 2, 3, 10, 11, 6, 7, 14, 15);
  out[2] = __builtin_shufflevector(ab_high, cd_high, 0, 1, 8, 9, 4, 5, 12, 13);
  out[3] = __builtin_shufflevector(ab_high, cd_high, 2, 3, 10, 11, 6, 7, 14, 15);
}

inline bool project(Lanes& lanes, const float (&start)[3], const FrameEvidence& f) {
  load(lanes.x, f.corner[0]);
  load(lanes.y, f.corner[1]);
  load(lanes.z, f.corner[2]);
  lanes.x += start[0];
  lanes.y += start[1];
  lanes.z += start[2];
  const Floats inverse = 1.0F / lanes.z;
  lanes.u = f.fx * lanes.x * inverse + (f.cx + 0.5F);
  lanes.v = f.fy * lanes.y * inverse + (f.cy + 0.5F);
  lanes.inside = (lanes.z > 1e-3F) & (lanes.u >= 0.0F) & (lanes.v >= 0.0F) &
                 (lanes.u < static_cast<float>(f.width)) & (lanes.v < static_cast<float>(f.height));
  // Lanes that do not count are made harmless before they become integers.
  lanes.u = lanes.inside ? lanes.u : Floats{};
  lanes.v = lanes.inside ? lanes.v : Floats{};
  return any(lanes.inside);
}

inline void meet_surface(Surface& s, const Lanes& lanes, const FrameEvidence& f) {
  Ints pixel =
      __builtin_convertvector(lanes.v, Ints) * f.width + __builtin_convertvector(lanes.u, Ints);
  pixel = lanes.inside ? pixel : Ints{} + f.width * f.height;
  static_assert(sizeof(PixelPlane) == sizeof(Quad));
  Quad planes[kLanes];
  for (int i = 0; i < kLanes; ++i) load(planes[i], &f.planes[pixel[i]]);
  Floats plane[4];
  transpose(planes, plane);
  s.along = plane[0] * lanes.x + plane[1] * lanes.y + plane[2] * lanes.z;
  s.known = s.along > 0.0F;
  s.trusted = plane[3] > 0.0F;
  s.distance = (s.trusted ? plane[3] : -plane[3]) - s.along;
  s.per_edge = s.along / lanes.z;
  s.ahead = s.distance / s.per_edge;
  s.depth = lanes.z + s.ahead;
  s.sigma = f.noise * s.depth * s.depth;
}

// Occupancy: Damen et al. eq. 5, see sensor_model.hpp. `margin` is measured across the surface.
inline void add_log_odds(VoxelCube& cube, const Surface& s, const Floats& margin,
                         const Ints& banded, const FrameEvidence& f) {
  const Floats magnitude = s.distance < 0.0F ? -s.distance : s.distance;
  const Ints hit = banded & (magnitude <= margin);
  const Ints in_front = banded & (s.distance > margin);
  Ints change = in_front & (Ints{} + f.free);
  if (any(hit)) {
    Floats column = magnitude / margin * static_cast<float>(HitTable::kColumns);
    Floats line = static_cast<float>(HitTable::kRowsPerRatio) / (s.sigma * s.per_edge);
    least(column, Floats{} + static_cast<float>(HitTable::kColumns - 1));
    least(line, Floats{} + static_cast<float>(HitTable::kRows - 1));
    line = hit ? line : Floats{};
    column = hit ? column : Floats{};
    Ints entry = __builtin_convertvector(line, Ints) * HitTable::kColumns +
                 __builtin_convertvector(column, Ints);
    for (int i = 0; i < kLanes; ++i) entry[i] = f.hits[entry[i]];
    change |= hit & entry;
  }
  Shorts stored;
  load(stored, cube.log_odds);
  Ints sum = __builtin_convertvector(stored, Ints) + change;
  sum = sum > f.highest ? Ints{} + f.highest : sum;
  sum = sum < f.lowest ? Ints{} + f.lowest : sum;
  store(cube.log_odds, __builtin_convertvector(sum, Shorts));
}

// Bilinear between the four pixels around; NaN where one of them is unknown.
inline void intensity_at(Floats& out, const Lanes& lanes, const FrameEvidence& f) {
  Floats u = lanes.u - 0.5F;
  Floats v = lanes.v - 0.5F;
  most(u, Floats{});
  most(v, Floats{});
  least(u, Floats{} + static_cast<float>(f.width - 1));
  least(v, Floats{} + static_cast<float>(f.height - 1));
  Ints column = __builtin_convertvector(u, Ints);
  Ints line = __builtin_convertvector(v, Ints);
  column = column > f.width - 2 ? Ints{} + (f.width - 2) : column;
  line = line > f.height - 2 ? Ints{} + (f.height - 2) : line;
  const Floats a = u - __builtin_convertvector(column, Floats);
  const Floats b = v - __builtin_convertvector(line, Floats);
  const Ints at = line * f.width + column;
  Quad squares[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const float* upper = f.intensity + at[i];
    std::memcpy(&squares[i], upper, 2 * sizeof(float));
    std::memcpy(reinterpret_cast<char*>(&squares[i]) + 2 * sizeof(float), upper + f.width,
                2 * sizeof(float));
  }
  Floats p[4];
  transpose(squares, p);
  const Floats upper = p[0] + a * (p[1] - p[0]);
  const Floats lower = p[2] + a * (p[3] - p[2]);
  out = upper + b * (lower - upper);
}

inline void add_intensity(VoxelCube& cube, const Lanes& lanes, const Ints& near,
                          const Floats& share, const FrameEvidence& f) {
  Floats seen;
  intensity_at(seen, lanes, f);
  const Ints valid = near & (seen >= 0.0F);
  Words stored;
  load(stored, cube.intensity);
  const Floats before = __builtin_convertvector(stored, Floats);
  Floats rate = share;
  most(rate, Floats{} + f.intensity_rate);
  least(seen, Floats{} + 1.0F);
  Floats mean = before + rate * (seen * (1.0F / kIntensityUnit) - before) + 0.5F;
  mean = valid ? mean : Floats{};
  const Ints kept = __builtin_convertvector(stored, Ints);
  const Ints fresh = __builtin_convertvector(mean, Ints);
  store(cube.intensity, __builtin_convertvector(valid ? fresh : kept, Words));
}

// Signed distance: running weighted mean (Curless and Levoy, "A volumetric method for building
// complex models from range images", 1996). The weight falls with the square of the depth and
// with the square of the slant's cosine.
inline void add_distance(VoxelCube& cube, const Lanes& lanes, const Surface& s, const Ints& valid,
                         const FrameEvidence& f) {
  Words stored_weight;
  Shorts stored_distance;
  load(stored_weight, cube.weight);
  load(stored_distance, cube.distance);
  Floats weight = __builtin_convertvector(stored_weight, Floats);
  Floats distance = __builtin_convertvector(stored_distance, Floats);

  Floats range = lanes.x * lanes.x + lanes.y * lanes.y + lanes.z * lanes.z;
  square_root(range);
  const Floats metres = s.depth * f.voxel;
  Floats gain = s.along * s.per_edge * (1.0F / kWeightUnit) / (range * metres * metres);
  most(gain, Floats{} + 1.0F);
  least(gain, Floats{} + 4.0F / kWeightUnit);
  Floats measured = s.distance;
  least(measured, 3.0F + 3.0F * s.sigma);
  least(measured, Floats{} + 15.0F);
  const Floats share = gain / (weight + gain);
  distance += share * (measured * (1.0F / kDistanceUnit) - distance);
  weight += gain;
  least(weight, Floats{} + f.max_weight);

  distance = valid ? distance : Floats{};
  weight = valid ? weight : Floats{};
  // Rounded to nearest: conversion truncates, so the value is made positive first.
  const Ints new_distance = __builtin_convertvector(distance + 32768.5F, Ints) - 32768;
  const Ints new_weight = __builtin_convertvector(weight + 0.5F, Ints);
  const Ints old_distance = __builtin_convertvector(stored_distance, Ints);
  const Ints old_weight = __builtin_convertvector(stored_weight, Ints);
  store(cube.distance, __builtin_convertvector(valid ? new_distance : old_distance, Shorts));
  store(cube.weight, __builtin_convertvector(valid ? new_weight : old_weight, Words));
  if (!f.intensity) return;
  const Ints near = valid & (s.distance < 2.0F);
  if (any(near)) add_intensity(cube, lanes, near, share, f);
}

inline bool update_cube(const VoxelCube& before, const float (&start)[3], const FrameEvidence& f,
                        VoxelCube& after) {
  Lanes lanes;
  if (!project(lanes, start, f)) return false;
  Surface s;
  meet_surface(s, lanes, f);
  const Floats band = 3.0F + 3.0F * s.sigma;
  // A little over half a voxel: of a surface midway between voxels neither may round away.
  const Floats noise = s.sigma * s.per_edge;  // across the surface
  Floats margin = 3.0F * noise;
  most(margin, Floats{} + 0.501F);
  // Interpolation needs all eight voxels around the surface: two edges to each side of it, however
  // slanted. What is known farther in front is free now.
  Floats reach = 2.0F * noise;
  most(reach, Floats{} + 2.0F);
  // Behind the margin nothing is said about occupancy: the rest of the band is left alone.
  const Ints in_band = s.known & (s.ahead <= band);
  const Ints in_reach = s.known & (s.distance >= (s.trusted ? -reach : margin));
  Ints banded = in_band & (s.distance >= (s.trusted ? -margin : margin));
  Ints valid = in_reach & ((s.distance <= reach) | in_band);
  if (f.carve) banded = valid = s.known & (s.ahead > band);
  // Most cubes end here, their memory untouched.
  if (!any(banded | valid)) return false;
  Words weight;
  load(weight, before.weight);
  const Ints known = __builtin_convertvector(weight, Ints) > 0;
  if (f.carve) banded &= known;
  valid &= known | (f.carve ? Ints{} : s.distance <= reach);
  if (!any(banded | valid)) return false;
  after = before;
  if (any(banded)) add_log_odds(after, s, margin, banded, f);
  if (any(valid)) add_distance(after, lanes, s, valid, f);
  return true;
}

}  // namespace

std::uint64_t cubes_in_reach(const float (&origin)[3], const FrameEvidence& frame) {
  std::uint64_t cubes = 0;
  for (int first = 0; first < kBlockVoxels / 8; first += kLanes) {
    Floats x, y, z;
    load(x, frame.centre[0] + first);
    load(y, frame.centre[1] + first);
    load(z, frame.centre[2] + first);
    x += origin[0];
    y += origin[1];
    z += origin[2];
    const Floats inverse = 1.0F / z;
    Floats column = frame.tile_fx * x * inverse + frame.tile_cx;
    Floats row = frame.tile_fy * y * inverse + frame.tile_cy;
    const Ints tiled = z >= frame.tiles_from;
    const Ints inside = tiled & (column >= 0.0F) & (row >= 0.0F) &
                        (column < static_cast<float>(frame.tile_columns)) &
                        (row < static_cast<float>(frame.tile_rows));
    column = inside ? column : Floats{};
    row = inside ? row : Floats{};
    const Ints tile = __builtin_convertvector(row, Ints) * frame.tile_columns +
                      __builtin_convertvector(column, Ints);
    Floats near = Floats{} + frame.anywhere.near;
    Floats far = Floats{} + frame.anywhere.far;
    for (int i = 0; i < kLanes; ++i) {
      if (inside[i] == 0) continue;
      near[i] = frame.tiles[tile[i]].near;
      far[i] = frame.tiles[tile[i]].far;
    }
    const Ints reached =
        (inside | ~tiled) & (z + frame.half_depth >= near) & (z - frame.half_depth <= far);
    for (int i = 0; i < kLanes; ++i) {
      cubes |= static_cast<std::uint64_t>(reached[i] & 1) << (first + i);
    }
  }
  return cubes;
}

std::uint64_t update_cubes(const Block& block, const float (&origin)[3], std::uint64_t cubes,
                           const FrameEvidence& frame, BlockCubes& updated) {
  std::uint64_t changed = 0;
  for (; cubes != 0; cubes &= cubes - 1) {
    const int cube = __builtin_ctzll(cubes);
    const float* offset = frame.cube[cube];
    const float start[3] = {origin[0] + offset[0], origin[1] + offset[1], origin[2] + offset[2]};
    if (update_cube(block.cubes[cube], start, frame, updated[cube])) changed |= cubes & -cubes;
  }
  return changed;
}

}  // namespace armsreach::mapping::ARMSREACH_KERNEL_LEVEL
