#include "vision/mapping/sensor_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "vision/mapping/block.hpp"

namespace armsreach::mapping {
namespace {

// Damen et al., eq. 5, written out: the integral by the midpoint rule in ten thousand steps.
double closed_form(double d, double v, double s, double k) {
  const double sigma = k * d * d;
  const double m = std::max(3 * sigma, s / 2);
  if (d - v > m) return 0.4;
  if (d - v < -m) return 0.5;
  double integral = 0;
  constexpr int kSteps = 10000;
  for (int i = 0; i < kSteps; ++i) {
    const double x = v - s / 2 + s * (i + 0.5) / kSteps;
    const double e = (x - d) / sigma;
    integral += std::exp(-e * e / 2) / (sigma * std::sqrt(2 * std::numbers::pi)) * s / kSteps;
  }
  return std::min((1 + integral) / 2, 0.97);
}

TEST(SensorModel, IsEquationFive) {
  const SensorModel model;
  for (const double s : {0.005, 0.01, 0.02}) {
    for (const double d : {0.4, 0.8, 1.5, 2.5, 4.0, 6.0}) {
      for (int i = -40; i <= 40; ++i) {
        const double v = d + 0.1 * i * model.band(d, s) / 4;
        // The midpoint rule's own error near the camera, where sigma is a fortieth of the voxel.
        EXPECT_NEAR(model.probability(d, v, s), closed_form(d, v, s, 1.425e-3), 1e-4)
            << "s " << s << " d " << d << " v " << v;
      }
    }
  }
}

TEST(SensorModel, TheVoxelThatHoldsTheSurfaceIsOccupiedHoweverNear) {
  const SensorModel model;
  // Equation 5 without the floor on m calls it free: here 3 sigma is 0.7 mm, the offset 4 mm.
  EXPECT_GT(model.probability(0.4, 0.396, 0.01), 0.9);
  EXPECT_EQ(model.probability(0.4, 0.394, 0.01), 0.4);
  EXPECT_EQ(model.probability(0.4, 0.406, 0.01), 0.5);
}

TEST(HitTable, FollowsTheModel) {
  const SensorModel model;
  const HitTable table(model);
  const double d = 1.4;
  for (double ratio = 0.2; ratio < 9; ratio += 0.37) {
    const double extent = ratio * model.sigma(d);
    const double m = model.margin(d, extent);
    for (double part = 0.02; part < 1; part += 0.06) {
      const int row = std::min(static_cast<int>(ratio * HitTable::kRowsPerRatio), 127);
      const int column = static_cast<int>(part * HitTable::kColumns);
      const double tabulated =
          static_cast<double>(table.data()[row * HitTable::kColumns + column]) *
          static_cast<double>(kLogOddsUnit);
      const double exact = log_odds(model.probability(d, d - part * m, extent));
      // Half a cell of the table, steepest where the noise is a sixth of the voxel and P falls from
      // 1 to 3/4 within a fifth of the margin; where P is nearly 1, log-odds are steep themselves.
      EXPECT_NEAR(tabulated, exact, 0.25) << "ratio " << ratio << " part " << part;
    }
  }
}

}  // namespace
}  // namespace armsreach::mapping
