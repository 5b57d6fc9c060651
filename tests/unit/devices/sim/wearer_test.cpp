#include "devices/sim/wearer.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace armsreach::sim {
namespace {

PathDescription ten_seconds() {
  PathDescription path;
  path.duration = 10;
  return path;
}

WearerKey key(double time, double y, double reach = 0) {
  WearerKey made;
  made.time = time;
  made.stand = {0, y};
  made.heading = M_PI / 2;  // towards +y
  made.look = {0, 6, 1};
  made.reach = reach;
  return made;
}

double spread(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

TEST(Wearer, StandsAtTheirHeightAndSwaysALittle) {
  WearerDescription person;
  person.height = 1.8;
  person.keys = {key(0, 0)};
  const Wearer wearer(person, ten_seconds(), 1);
  std::vector<double> across;
  for (double time = 0; time < 10; time += 0.1) {
    const Pose head = wearer.world_from_head(time);
    EXPECT_NEAR(head.translation().z(), 0.936 * 1.8, 0.04);  // eye level
    EXPECT_LT(wearer.world_from_shoulder(time).translation().z(), head.translation().z() - 0.1);
    across.push_back(head.translation().x());
  }
  EXPECT_GT(spread(across), 0.004);
  EXPECT_LT(spread(across), 0.04);
}

TEST(Wearer, LooksWhereTheEyesRestAndWearsTheShoulderCameraOnTheRight) {
  WearerDescription person;
  person.sway = 0;
  person.keys = {key(0, 0)};
  const Wearer wearer(person, ten_seconds(), 1);
  const Pose head = wearer.world_from_head(0);
  const Eigen::Vector3d seen = head.inverse() * person.keys[0].look;
  EXPECT_LT(seen.head<2>().norm() / seen.z(), 0.003);
  const Pose shoulder = wearer.world_from_shoulder(0);
  EXPECT_GT(shoulder.translation().x(), 0.15);  // facing +y, the right is +x
  const Eigen::Vector3d ahead = shoulder.rotation() * Eigen::Vector3d::UnitZ();
  EXPECT_GT(ahead.y(), 0.7);
  EXPECT_LT(ahead.z(), -0.4);
}

// At a comfortable pace a body rises and falls by some centimetres, twice a stride.
TEST(Wearer, BobsWhenWalking) {
  WearerDescription person;
  person.sway = 0;
  person.keys = {key(0, 0), key(2, 2), key(4, 4)};
  const Wearer wearer(person, ten_seconds(), 1);
  std::vector<double> height;
  int peaks = 0;
  for (double time = 1; time < 3; time += 0.01) {
    height.push_back(wearer.world_from_shoulder(time).translation().z());
    const std::size_t n = height.size();
    peaks += n > 2 && height[n - 2] > height[n - 3] && height[n - 2] > height[n - 1];
  }
  EXPECT_GT(spread(height), 0.01);
  EXPECT_LT(spread(height), 0.06);
  // 2 m at 0.8 x 1.7 m a stride are about 3 steps.
  EXPECT_GE(peaks, 2);
  EXPECT_LE(peaks, 4);
  height.clear();
  for (double time = 6; time < 9; time += 0.01)
    height.push_back(wearer.world_from_shoulder(time).translation().z());
  EXPECT_LT(spread(height), 0.002) << "who has arrived stands still";
}

TEST(Wearer, ReachesForwardByBending) {
  WearerDescription person;
  person.sway = 0;
  person.keys = {key(0, 0), key(5, 0, 1)};
  const Wearer wearer(person, ten_seconds(), 1);
  const Pose upright = wearer.world_from_shoulder(0);
  const Pose bent = wearer.world_from_shoulder(5);
  EXPECT_GT(bent.translation().y() - upright.translation().y(), 0.15);
  EXPECT_LT(bent.translation().z(), upright.translation().z());
}

}  // namespace
}  // namespace armsreach::sim
