// What one depth measurement says about a voxel. Source: Damen et al., "Egocentric Real-time
// Workspace Monitoring using an RGB-D Camera", IROS 2012, eq. 5, with two changes for voxels that
// are wider than the noise. The margin is at least half a voxel, or eq. 5 would call the voxel that
// holds the surface free; and a voxel's `extent` is its edge along the viewing ray, voxel /
// cos(slant), or of a slanted surface between voxel centres nothing at all would be occupied.
#pragma once

#include <cstdint>
#include <vector>

namespace armsreach::mapping {

struct SensorModel {
  double noise = 1.425e-3;     // k [1/m] in sigma = k d^2; the Kinect's
  double free = 0.4;           // P(occupied) of a voxel in front of the surface
  double most_certain = 0.97;  // P(occupied) that one measurement may claim at most

  double sigma(double depth) const { return noise * depth * depth; }
  // Beyond this distance [m] in front or behind, a voxel is not the surface.
  double margin(double depth, double extent) const;
  // Half the depth of the band that a measurement updates, along the ray [m].
  double band(double depth, double voxel) const { return 3 * sigma(depth) + 3 * voxel; }
  // P(occupied | depth) for a voxel at `voxel_depth`; both are z in the camera's frame.
  double probability(double depth, double voxel_depth, double extent) const;
};

double log_odds(double probability);
std::int16_t fixed_log_odds(double probability);  // in kLogOddsUnit

// Log-odds of hits within the margin, tabulated in fixed point (kLogOddsUnit) over extent / sigma
// and |depth - voxel_depth| / margin.
class HitTable {
 public:
  static constexpr int kColumns = 64;
  static constexpr int kRows = 128;
  static constexpr int kRowsPerRatio = 16;  // beyond a ratio of eight a voxel is hit or it is not

  explicit HitTable(const SensorModel& model);
  const std::int16_t* data() const { return values_.data(); }

 private:
  std::vector<std::int16_t> values_;
};

}  // namespace armsreach::mapping
