// Compiled once a processor level, into the namespace ARMSREACH_KERNEL_LEVEL. Nothing with external
// linkage may be instantiated here: the linker would keep one level's copy for all.
#include <cstring>

#include "vision/mapping/update_block.hpp"

namespace armsreach::mapping::ARMSREACH_KERNEL_LEVEL {
bool update_block(Block& block, const float (&origin)[3], const FrameEvidence& frame);

namespace {

// Eight lanes, a row of voxels along x (vector extension of GCC and Clang).
using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));
using Shorts = std::int16_t __attribute__((vector_size(16)));
using Words = std::uint16_t __attribute__((vector_size(16)));
constexpr int kLanes = 8;

struct Row {
  Floats x, y, z;  // of the voxels' centres
  Floats u, v;     // px, +0.5: the pixel is their integer part
  Ints inside;     // the image, as masks
};

struct Surface {
  Floats distance;  // from the voxel to its pixel's plane, positive in front
  Floats ahead;     // the same along z, on the voxel's ray: d - v_d
  Floats depth;     // d
  Floats sigma;
  Floats cosine;  // of the angle between ray and normal
  Ints known;
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

inline bool project_row(Row& row, const float (&start)[3], const FrameEvidence& f) {
  const Floats lane = {0, 1, 2, 3, 4, 5, 6, 7};
  row.x = start[0] + lane * f.step[0][0];
  row.y = start[1] + lane * f.step[0][1];
  row.z = start[2] + lane * f.step[0][2];
  const Floats inverse = 1.0F / row.z;
  row.u = f.fx * row.x * inverse + (f.cx + 0.5F);
  row.v = f.fy * row.y * inverse + (f.cy + 0.5F);
  row.inside = (row.z > 1e-3F) & (row.u >= 0.0F) & (row.v >= 0.0F) &
               (row.u < static_cast<float>(f.width)) & (row.v < static_cast<float>(f.height));
  return any(row.inside);
}

inline void meet_surface(Surface& s, const Row& row, const FrameEvidence& f) {
  Ints pixel =
      __builtin_convertvector(row.v, Ints) * f.width + __builtin_convertvector(row.u, Ints);
  pixel = row.inside ? pixel : Ints{} + f.width * f.height;
  Floats x, y, z, distance;
  for (int i = 0; i < kLanes; ++i) {
    const PixelPlane& plane = f.planes[pixel[i]];
    x[i] = plane.x;
    y[i] = plane.y;
    z[i] = plane.z;
    distance[i] = plane.distance;
  }
  const Floats along = x * row.x + y * row.y + z * row.z;
  s.known = along > 0.0F;
  s.distance = distance - along;
  s.ahead = row.z * s.distance / along;
  s.depth = row.z + s.ahead;
  s.sigma = f.noise * s.depth * s.depth;
  Floats range = row.x * row.x + row.y * row.y + row.z * row.z;
  square_root(range);
  s.cosine = along / range;
}

// Occupancy: Damen et al. eq. 5, see sensor_model.hpp.
inline void add_log_odds(Block& block, int at, const Surface& s, const Ints& banded,
                         const FrameEvidence& f) {
  Floats margin = 3.0F * s.sigma;
  most(margin, Floats{} + 0.5F);
  const Floats magnitude = s.ahead < 0.0F ? -s.ahead : s.ahead;
  const Ints hit = banded & (magnitude <= margin);
  const Ints in_front = banded & (s.ahead > margin);
  Ints change = in_front & (Ints{} + f.free);
  if (any(hit)) {
    Floats column = magnitude / margin * 64.0F;
    least(column, Floats{} + 63.0F);
    Floats line = s.depth * f.hit_rows_per_edge;
    least(line, Floats{} + static_cast<float>(f.hit_rows - 1));
    Ints entry = __builtin_convertvector(line, Ints) * 64 + __builtin_convertvector(column, Ints);
    entry &= hit;
    for (int i = 0; i < kLanes; ++i) entry[i] = f.hits[entry[i]];
    change |= hit & entry;
  }
  Shorts stored;
  load(stored, &block.log_odds[at]);
  Ints sum = __builtin_convertvector(stored, Ints) + change;
  sum = sum > f.highest ? Ints{} + f.highest : sum;
  sum = sum < f.lowest ? Ints{} + f.lowest : sum;
  store(&block.log_odds[at], __builtin_convertvector(sum, Shorts));
}

// Bilinear at a pixel; NaN where one of the four around it is unknown.
inline float intensity_at(const FrameEvidence& f, float u, float v) {
  const float left = u < 0 ? 0 : u;
  const float top = v < 0 ? 0 : v;
  int column = static_cast<int>(left);
  int line = static_cast<int>(top);
  column = column > f.width - 2 ? f.width - 2 : column;
  line = line > f.height - 2 ? f.height - 2 : line;
  const float a = left - static_cast<float>(column) > 1 ? 1 : left - static_cast<float>(column);
  const float b = top - static_cast<float>(line) > 1 ? 1 : top - static_cast<float>(line);
  const float* p = f.intensity + line * f.width + column;
  const float upper = p[0] + a * (p[1] - p[0]);
  const float lower = p[f.width] + a * (p[f.width + 1] - p[f.width]);
  return upper + b * (lower - upper);
}

inline void add_intensity(Block& block, int at, const Row& row, const Ints& near,
                          const Floats& share, const FrameEvidence& f) {
  for (int i = 0; i < kLanes; ++i) {
    if (!near[i]) continue;
    const float seen = intensity_at(f, row.u[i] - 0.5F, row.v[i] - 0.5F);
    if (!(seen >= 0)) continue;
    const float rate = share[i] > f.intensity_rate ? share[i] : f.intensity_rate;
    const float stored = static_cast<float>(block.intensity[at + i]);
    const float top = seen < 1 ? seen * 65535.0F : 65535.0F;
    block.intensity[at + i] = static_cast<std::uint16_t>(stored + rate * (top - stored) + 0.5F);
  }
}

// Signed distance: running weighted mean (Curless and Levoy, "A volumetric method for building
// complex models from range images", 1996). The weight falls with the square of the depth and with
// the slant.
inline void add_distance(Block& block, int at, const Row& row, const Surface& s, const Ints& valid,
                         const FrameEvidence& f) {
  Words stored_weight;
  Shorts stored_distance;
  load(stored_weight, &block.weight[at]);
  load(stored_distance, &block.distance[at]);
  Floats weight = __builtin_convertvector(stored_weight, Floats);
  Floats distance = __builtin_convertvector(stored_distance, Floats);

  const Floats metres = s.depth * f.voxel;
  Floats gain = s.cosine / (metres * metres) * (1.0F / kWeightUnit);
  most(gain, Floats{} + 1.0F);
  least(gain, Floats{} + 4.0F / kWeightUnit);
  Floats measured = s.distance;
  least(measured, 3.0F + 3.0F * s.sigma);
  least(measured, Floats{} + 15.0F);
  const Floats share = gain / (weight + gain);
  distance += share * (measured * (1.0F / kDistanceUnit) - distance);
  weight += gain;
  least(weight, Floats{} + f.max_weight);

  // Rounded to nearest: conversion truncates, so the value is made positive first.
  const Ints new_distance = __builtin_convertvector(distance + 32768.5F, Ints) - 32768;
  const Ints new_weight = __builtin_convertvector(weight + 0.5F, Ints);
  const Ints old_distance = __builtin_convertvector(stored_distance, Ints);
  const Ints old_weight = __builtin_convertvector(stored_weight, Ints);
  store(&block.distance[at], __builtin_convertvector(valid ? new_distance : old_distance, Shorts));
  store(&block.weight[at], __builtin_convertvector(valid ? new_weight : old_weight, Words));
  if (!f.intensity) return;
  const Ints near = valid & (s.distance < 2.0F);
  if (any(near)) add_intensity(block, at, row, near, share, f);
}

inline bool update_row(Block& block, int at, const float (&start)[3], const FrameEvidence& f) {
  Row row;
  if (!project_row(row, start, f)) return false;
  Surface s;
  meet_surface(s, row, f);
  const Floats band = 3.0F + 3.0F * s.sigma;
  Ints banded = s.known & (s.ahead <= band) & (s.ahead >= -band);
  if (f.carve) {
    Words weight;
    load(weight, &block.weight[at]);
    banded |= s.known & (s.ahead > band) & (__builtin_convertvector(weight, Ints) > 0);
  }
  // Interpolation needs all eight voxels around the surface: two edges behind it, however slanted.
  Floats behind = 2.0F * s.sigma;
  most(behind, Floats{} + 2.0F);
  const Ints valid = s.known & (s.distance >= -behind) & (banded | (s.distance <= 2.0F));
  if (!any(banded | valid)) return false;
  add_log_odds(block, at, s, banded, f);
  add_distance(block, at, row, s, valid, f);
  return true;
}

}  // namespace

bool update_block(Block& block, const float (&origin)[3], const FrameEvidence& frame) {
  bool changed = false;
  for (int z = 0; z < kBlockEdge; ++z) {
    for (int y = 0; y < kBlockEdge; ++y) {
      float start[3];
      for (int i = 0; i < 3; ++i) {
        start[i] = origin[i] + static_cast<float>(y) * frame.step[1][i] +
                   static_cast<float>(z) * frame.step[2][i];
      }
      changed |= update_row(block, voxel_in_block(0, y, z), start, frame);
    }
  }
  if (!changed) return false;
  int occupied = 0;
  for (int i = 0; i < kBlockVoxels; ++i) {
    occupied |= block.log_odds[i] > frame.occupied_above;
  }
  block.occupied = occupied != 0;
  return true;
}

}  // namespace armsreach::mapping::ARMSREACH_KERNEL_LEVEL
