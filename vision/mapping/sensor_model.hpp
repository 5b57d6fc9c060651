// What one depth measurement says about a voxel. Source: Damen et al., "Egocentric Real-time
// Workspace Monitoring using an RGB-D Camera", IROS 2012, eq. 5, with the margin floored at half a
// voxel: near the camera a voxel is wider than the noise, and eq. 5 alone would call the voxel that
// holds the surface free.
#pragma once

#include <cstdint>
#include <vector>

namespace armsreach::mapping {

struct SensorModel {
  double noise = 1.425e-3;     // k [1/m] in sigma = k d^2; the Kinect's
  double free = 0.4;           // P(occupied) of a voxel in front of the surface
  double most_certain = 0.97;  // P(occupied) that one measurement may claim at most

  double sigma(double depth) const { return noise * depth * depth; }
  // Beyond this distance [m] in front or behind, a voxel with edge `voxel` is not the surface.
  double margin(double depth, double voxel) const;
  // Half the depth of the band that a measurement updates, along the ray [m].
  double band(double depth, double voxel) const { return 3 * sigma(depth) + 3 * voxel; }
  // P(occupied | depth) for a voxel at `voxel_depth`; both are z in the camera's frame.
  double probability(double depth, double voxel_depth, double voxel) const;
};

double log_odds(double probability);
std::int16_t fixed_log_odds(double probability);  // in kLogOddsUnit

// Log-odds of hits within the margin, tabulated in fixed point (kLogOddsUnit) over depth and
// |depth - voxel_depth| / margin.
class HitTable {
 public:
  static constexpr int kColumns = 64;

  HitTable(const SensorModel& model, double voxel, double max_range);
  const std::int16_t* data() const { return values_.data(); }
  int rows() const { return rows_; }
  double rows_per_metre() const { return rows_per_metre_; }

 private:
  int rows_;
  double rows_per_metre_;
  std::vector<std::int16_t> values_;
};

}  // namespace armsreach::mapping
