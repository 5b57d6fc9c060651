#include "vision/mapping/sensor_model.hpp"

#include <algorithm>
#include <cmath>

#include "vision/mapping/block.hpp"

namespace armsreach::mapping {

double SensorModel::margin(double depth, double extent) const {
  return std::max(3 * sigma(depth), extent / 2);
}

double SensorModel::probability(double depth, double voxel_depth, double extent) const {
  const double ahead = depth - voxel_depth;
  const double limit = margin(depth, extent);
  if (ahead > limit) return free;
  if (ahead < -limit) return 0.5;
  // The normal distribution's integral over the voxel's extent, by its error function.
  const double scale = 1 / (sigma(depth) * std::sqrt(2.0));
  const double inside =
      (std::erf((extent / 2 - ahead) * scale) + std::erf((extent / 2 + ahead) * scale)) / 2;
  return std::min((1 + inside) / 2, most_certain);
}

double log_odds(double probability) { return std::log(probability / (1 - probability)); }

std::int16_t fixed_log_odds(double probability) {
  return static_cast<std::int16_t>(
      std::lround(log_odds(probability) / static_cast<double>(kLogOddsUnit)));
}

HitTable::HitTable(const SensorModel& model) {
  values_.reserve(std::size_t{kRows} * kColumns);
  for (int row = 0; row < kRows; ++row) {
    const double depth = 1;
    const double extent = (row + 0.5) / kRowsPerRatio * model.sigma(depth);
    const double margin = model.margin(depth, extent);
    for (int column = 0; column < kColumns; ++column) {
      const double ahead = margin * (column + 0.5) / kColumns;
      values_.push_back(fixed_log_odds(model.probability(depth, depth - ahead, extent)));
    }
  }
}

}  // namespace armsreach::mapping
