#include "vision/registration/simplex.hpp"

#include <gtest/gtest.h>

namespace armsreach {
namespace {

TEST(Simplex, FollowsACurvedValley) {
  // Rosenbrock's function: its minimum, 0, is at (1, 1).
  const auto valley = [](const Eigen::VectorXd& p) {
    const double off = p[1] - p[0] * p[0];
    return 100 * off * off + (1 - p[0]) * (1 - p[0]);
  };
  const SimplexMinimum found = minimise(valley, Eigen::Vector2d(-1.2, 1), 0.5, 1e-6, 1000);
  EXPECT_NEAR(found.at[0], 1, 1e-4);  // 100 times what the simplex was shrunk to
  EXPECT_NEAR(found.at[1], 1, 1e-4);
  EXPECT_EQ(found.value, valley(found.at));
}

TEST(Simplex, NoStepsGiveTheBestOfTheStart) {
  const auto slope = [](const Eigen::VectorXd& p) { return p.sum(); };
  const SimplexMinimum found = minimise(slope, Eigen::Vector2d(3, 4), -1, 0.1, 0);
  EXPECT_DOUBLE_EQ(found.value, 6);
}

}  // namespace
}  // namespace armsreach
