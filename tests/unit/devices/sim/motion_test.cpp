#include "devices/sim/motion.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "devices/sim/worlds.hpp"

namespace armsreach::sim {
namespace {

Pose pose(double x, double z, double turn) {
  return {so3_exp(turn * Eigen::Vector3d::UnitZ()), {x, 0, z}};
}

Thing thing_with(std::vector<ThingKey> keys) {
  Thing thing;
  thing.world_from_thing = keys.front().world_from_thing;
  thing.keys = std::move(keys);
  thing.moves = true;
  return thing;
}

TEST(Motion, IsAtItsKeysAndRestsBetweenEqualOnes) {
  const Thing thing = thing_with({{0, pose(0, 0, 0)},
                                  {2, pose(0, 0, 0)},
                                  {3, pose(0.5, 0.3, 1)},
                                  {4, pose(1, 0, 2)},
                                  {6, pose(1, 0, 2)}});
  for (const ThingKey& key : thing.keys)
    EXPECT_LT((key.world_from_thing.inverse() * pose_at(thing, key.time)).log().norm(), 1e-12);
  for (const double time : {-1.0, 0.5, 1.9})
    EXPECT_EQ(pose_at(thing, time).translation(), Eigen::Vector3d(0, 0, 0));
  for (const double time : {4.5, 6.0, 9.0})
    EXPECT_LT((pose_at(thing, time).translation() - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
}

TEST(Motion, StartsAndStopsSoftlyAndPassesThroughWithoutAStop) {
  const Thing thing = thing_with({{0, pose(0, 0, 0)}, {1, pose(0.5, 0.3, 1)}, {2, pose(1, 0, 2)}});
  constexpr double kStep = 1e-4;
  const auto speed = [&](double time) {
    return (pose_at(thing, time + kStep).translation() - pose_at(thing, time - kStep).translation())
               .norm() /
           (2 * kStep);
  };
  EXPECT_LT(speed(kStep), 1e-3);
  EXPECT_LT(speed(2 - kStep), 1e-3);
  EXPECT_GT(speed(1), 0.4);
  // No jump of the velocity at the key: an acceleration of some m/s^2 changes it by 1e-3 here.
  EXPECT_NEAR(speed(1 - 2 * kStep), speed(1 + 2 * kStep), 5e-3);
}

TEST(Motion, WorldsThatCloseEndAsTheyBegin) {
  for (const std::string& name : world_names()) {
    const World world = *load_world(name);
    if (!world.path.closed) continue;
    for (const Thing& thing : world.things) {
      const Pose apart = thing.world_from_thing.inverse() * pose_at(thing, world.path.duration);
      EXPECT_LT(apart.log().norm(), 1e-9) << name << ": " << thing.name;
    }
  }
}

}  // namespace
}  // namespace armsreach::sim
