#include "vision/mapping/sensor_model.hpp"

#include <algorithm>
#include <cmath>

#include "vision/mapping/block.hpp"

namespace armsreach::mapping {

double SensorModel::margin(double depth, double voxel) const {
  return std::max(3 * sigma(depth), voxel / 2);
}

double SensorModel::probability(double depth, double voxel_depth, double voxel) const {
  const double ahead = depth - voxel_depth;
  const double limit = margin(depth, voxel);
  if (ahead > limit) return free;
  if (ahead < -limit) return 0.5;
  // The normal distribution's integral over the voxel, by its error function.
  const double scale = 1 / (sigma(depth) * std::sqrt(2.0));
  const double inside =
      (std::erf((voxel / 2 - ahead) * scale) + std::erf((voxel / 2 + ahead) * scale)) / 2;
  return std::min((1 + inside) / 2, most_certain);
}

double log_odds(double probability) { return std::log(probability / (1 - probability)); }

std::int16_t fixed_log_odds(double probability) {
  return static_cast<std::int16_t>(
      std::lround(log_odds(probability) / static_cast<double>(kLogOddsUnit)));
}

HitTable::HitTable(const SensorModel& model, double voxel, double max_range)
    : rows_(128), rows_per_metre_(rows_ / max_range) {
  values_.reserve(static_cast<std::size_t>(rows_) * kColumns);
  for (int row = 0; row < rows_; ++row) {
    const double depth = (row + 0.5) / rows_per_metre_;
    const double margin = model.margin(depth, voxel);
    for (int column = 0; column < kColumns; ++column) {
      const double ahead = margin * (column + 0.5) / kColumns;
      values_.push_back(fixed_log_odds(model.probability(depth, depth - ahead, voxel)));
    }
  }
}

}  // namespace armsreach::mapping
