#include "vision/gaze/inverse_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

using Eigen::Vector3d;

const Vector3d kUp(0, -1, 0);

struct View {
  double off;      // rad, of the optical axis from the point
  double torsion;  // rad, of the image's x axis above the plane across `up`
};
View view(const GimbalModel& model, const Vector3d& angles, const Vector3d& point,
          const Vector3d& up = kUp) {
  const Pose mount_from = mount_from_camera(model, angles);
  const Vector3d target = mount_from.inverse() * point;
  return {std::atan2(target.head<2>().norm(), target.z()),
          std::asin(up.dot(mount_from.rotation() * Vector3d::UnitX()))};
}

// A direction is a point far away.
GimbalSolution look_along(const GimbalModel& model, const Vector3d& direction, const Vector3d& up) {
  return look_at(model, 1e7 * direction.normalized(), up, Vector3d::Zero());
}

GimbalModel offset_model() {
  GimbalModel model;
  model.mount_from_base = Pose(so3_exp({0.1, -0.2, 0.05}), {0.01, -0.02, 0.03});
  model.offsets = {Vector3d(0.0, -0.03, 0.01), Vector3d(0.02, 0, 0.015), Vector3d(0, 0.01, 0.04)};
  return model;
}

TEST(InverseKinematics, LooksAtAnyPointUprightInEveryOrderOfTheAxes) {
  std::array order{GimbalAxis::pan, GimbalAxis::tilt, GimbalAxis::roll};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  do {
    GimbalModel model = offset_model();
    model.order = order;
    model.lower = {-1.57, -1.57, -1.2};  // a tilt before the pan must go farther up and down
    model.upper = -model.lower;
    for (int i = 0; i < 50; ++i) {
      // Within 55 degrees to the side and 35 up or down, from 0.3 m to 3 m.
      const double azimuth = 0.96 * uniform(random);
      const double elevation = 0.6 * uniform(random);
      const double range = 1.65 + 1.35 * uniform(random);
      const Vector3d point =
          range * Vector3d(std::sin(azimuth) * std::cos(elevation), -std::sin(elevation),
                           std::cos(azimuth) * std::cos(elevation));
      const auto found = look_at(model, point, kUp, Vector3d::Zero());
      const View seen = view(model, found.angles, point);
      EXPECT_TRUE(found.reachable());
      EXPECT_LT(seen.off, 1e-4) << point.transpose();
      EXPECT_NEAR(seen.torsion, 0, 1e-3) << point.transpose();
      EXPECT_NEAR(found.error, seen.off, 1e-6);
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

// With axes in one point and in the order pan, tilt, roll the angles have names of their own.
TEST(InverseKinematics, PanIsToTheRightAndTiltIsUp) {
  const GimbalModel model;
  const auto right = look_along(model, {1, 0, 1}, kUp);
  EXPECT_NEAR(right.angles[0], M_PI / 4, 1e-6);
  EXPECT_NEAR(right.angles[1], 0, 1e-6);
  const auto above = look_along(model, {0, -1, 2}, kUp);
  EXPECT_NEAR(above.angles[1], std::atan(0.5), 1e-6);
  EXPECT_NEAR(above.angles[2], 0, 1e-6);
}

TEST(InverseKinematics, RollMakesUpForATiltedMount) {
  const GimbalModel model;
  const Vector3d up = so3_exp({0, 0, 0.3}) * kUp;  // the wearer leans to one side
  const auto found = look_along(model, {0.5, 0.2, 1}, up);
  EXPECT_TRUE(found.reachable());
  EXPECT_NEAR(found.torsion, 0, 1e-6);
  EXPECT_GT(std::abs(found.angles[2]), 0.2);
}

TEST(InverseKinematics, WhereRollEndsTheTargetGoesFirst) {
  GimbalModel model;
  model.lower[2] = -0.1;
  model.upper[2] = 0.1;
  const Vector3d up = so3_exp({0, 0, 0.5}) * kUp;
  const auto found = look_along(model, {0.3, 0.1, 1}, up);
  EXPECT_TRUE(found.reachable());
  EXPECT_NEAR(std::abs(found.angles[2]), 0.1, 1e-9);
  EXPECT_NEAR(std::abs(found.torsion), 0.4, 0.05);
}

TEST(InverseKinematics, SaysWhatCannotBeReachedAndLooksAsNearAsItCan) {
  GimbalModel model;
  model.lower[0] = -0.5;
  model.upper[0] = 0.5;
  const auto found = look_along(model, {std::sin(0.8), 0, std::cos(0.8)}, kUp);
  EXPECT_FALSE(found.reachable());
  EXPECT_NEAR(found.error, 0.3, 1e-3);
  EXPECT_NEAR(found.angles[0], 0.5, 1e-9);
  const auto behind = look_along(model, {0, 0, -1}, kUp);
  EXPECT_FALSE(behind.reachable());
  EXPECT_TRUE(behind.angles.allFinite());
}

TEST(InverseKinematics, PointsInTheCameraItselfGiveFiniteAngles) {
  const auto found = look_at(GimbalModel{}, Vector3d::Zero(), kUp, Vector3d::Zero());
  EXPECT_TRUE(found.angles.allFinite());
}

}  // namespace
}  // namespace armsreach
