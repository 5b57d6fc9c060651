#include "devices/sim/path.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "devices/sim/worlds.hpp"

namespace armsreach::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFrame = 1.0 / 30;  // s

PathDescription square(bool closed) {
  PathDescription path;
  path.duration = 4;
  path.closed = closed;
  path.keys = {{0, {0, 0, 1}, {0, 3, 1}, 0},
               {1, {1, 0, 1}, {0, 3, 1}, 0},
               {2, {1, 1, 1}, {0, 3, 1}, 0.1},
               {3, {0, 1, 1}, {0, 3, 1}, 0}};
  return path;
}

TEST(Path, GoesThroughItsKeysAndLooksAtTheirTargets) {
  const PathDescription description = square(true);
  const CameraPath path(description, 1);
  for (const PathKey& key : description.keys) {
    const Pose pose = path.world_from_camera(key.time);
    EXPECT_LT((pose.translation() - key.eye).norm(), 1e-12);
    const Eigen::Vector3d target = pose.inverse() * key.target;
    EXPECT_LT(target.head<2>().norm(), 1e-12);
    EXPECT_GT(target.z(), 0);
  }
  // Without roll the picture's lower edge points down.
  const Eigen::Vector3d down = path.world_from_camera(0).rotation() * Eigen::Vector3d::UnitY();
  EXPECT_LT((down + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(Path, ClosesWithItsTremor) {
  PathDescription description = square(true);
  description.tremor = {0.003, 0.005, 0.0002, 0.0005};
  const CameraPath path(description, 3);
  for (const double time : {0.0, 0.7, 3.9}) {
    const Pose once = path.world_from_camera(time);
    const Pose again = path.world_from_camera(time + 2 * description.duration);
    EXPECT_LT((once.inverse() * again).log().norm(), 1e-9);
  }
}

TEST(Path, AnOpenPathStaysAtItsEnd) {
  const CameraPath path(square(false), 1);
  const Pose end = path.world_from_camera(4);
  EXPECT_LT((end.inverse() * path.world_from_camera(9)).log().norm(), 1e-12);
}

// Velocity and acceleration without jumps: third differences of a curve with continuous second
// derivative shrink with the cube of the step, those of one with a kink or a jump do not.
TEST(Path, IsSmoothAcrossKeysAndTheSeam) {
  const CameraPath path(square(true), 1);
  const auto third_difference = [&path](double time, double step) {
    const auto eye = [&](int i) { return path.world_from_camera(time + i * step).translation(); };
    return (eye(2) - 3 * eye(1) + 3 * eye(0) - eye(-1)).norm();
  };
  for (const double key : {0.0, 1.0, 2.0, 3.0, 4.0}) {
    const double coarse = third_difference(key - 0.0005, 0.01);
    const double fine = third_difference(key - 0.00025, 0.005);
    EXPECT_LT(fine, coarse / 6) << key;
  }
}

struct Steps {
  double mean_length = 0;  // m a frame
  double most_length = 0;
  double mean_angle = 0;  // rad a frame
  double most_angle = 0;
};

Steps steps_of(const World& world) {
  const CameraPath path(world.path, 1);
  const int frames = static_cast<int>(path.duration() / kFrame);
  Steps steps;
  for (int i = 0; i < frames; ++i) {
    const Pose a = path.world_from_camera(i * kFrame);
    const Pose b = path.world_from_camera((i + 1) * kFrame);
    const double length = (b.translation() - a.translation()).norm();
    const double angle = so3_log((a.inverse() * b).rotation()).norm();
    steps.mean_length += length / frames;
    steps.mean_angle += angle / frames;
    steps.most_length = std::max(steps.most_length, length);
    steps.most_angle = std::max(steps.most_angle, angle);
  }
  return steps;
}

TEST(Path, TheBenchIsWalkedAtAHandsPace) {
  const Steps steps = steps_of(*load_world("bench"));
  EXPECT_GT(steps.mean_length, 0.003);
  EXPECT_LT(steps.most_length, 0.02);  // 0.6 m/s
  EXPECT_GT(steps.mean_angle, 0.15 * kDegree);
  EXPECT_LT(steps.most_angle, 1.2 * kDegree);
}

TEST(Path, NearMovesOneToTwoCentimetresAndAboutOnePointSixDegreesAFrame) {
  const Steps steps = steps_of(*load_world("near"));
  EXPECT_GT(steps.mean_length, 0.010);
  EXPECT_LT(steps.mean_length, 0.020);
  EXPECT_LT(steps.most_length, 0.030);
  EXPECT_NEAR(steps.mean_angle, 1.6 * kDegree, 0.3 * kDegree);
  EXPECT_LT(steps.most_angle, 4 * kDegree);
}

TEST(Path, AnotherSeedHoldsTheCameraDifferently) {
  const World world = *load_world("bench");
  const Pose a = CameraPath(world.path, 1).world_from_camera(1);
  const Pose b = CameraPath(world.path, 2).world_from_camera(1);
  const double apart = (a.translation() - b.translation()).norm();
  EXPECT_GT(apart, 1e-5);
  EXPECT_LT(apart, 0.05);
}

}  // namespace
}  // namespace armsreach::sim
