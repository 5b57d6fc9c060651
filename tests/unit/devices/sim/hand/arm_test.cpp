#include "devices/sim/hand/arm.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;

const Vector3d kDown(0, 0, -1);

// A hand palm down, fingers along y, and shoulders behind and above it.
Arm arm_to(const Vector3d& shoulder, const HandPose& pose = HandPose::Zero()) {
  return arm_to_shoulder(mean_anatomy(), pose, shoulder, kDown);
}

TEST(Arm, HasBonesOfTheirLengthAndHangsDown) {
  for (const Vector3d& shoulder :
       {Vector3d(0, -0.4, 0.3), Vector3d(0.2, -0.35, 0.2), Vector3d(-0.1, -0.45, 0.1)}) {
    const Arm arm = arm_to(shoulder);
    EXPECT_LT((arm.shoulder - shoulder).norm(), 1e-12);
    EXPECT_NEAR(arm.elbow.norm(), forearm_bone(mean_anatomy()), 1e-9);
    EXPECT_NEAR((arm.elbow - arm.shoulder).norm(), upper_arm_bone(mean_anatomy()), 1e-9);
    // Below the straight line from the wrist to the shoulder.
    const double share = arm.elbow.y() / shoulder.y();
    EXPECT_LT(arm.elbow.z(), share * shoulder.z());
  }
}

TEST(Arm, WhoCannotReachStretches) {
  const Vector3d shoulder(0, -0.8, 0.2);
  const Arm arm = arm_to(shoulder);
  EXPECT_LT((arm.shoulder - shoulder).norm(), 1e-12);
  EXPECT_NEAR(arm.elbow.norm(), forearm_bone(mean_anatomy()), 1e-9);
  // Nearly straight.
  EXPECT_GT(arm.elbow.normalized().dot(shoulder.normalized()), 0.95);
}

TEST(Arm, TheWristStaysWithinItsLimits) {
  const HandLimits& limits = hand_limits();
  for (const Vector3d& shoulder :
       {Vector3d(0, 0.5, 0), Vector3d(0.5, 0, 0), Vector3d(0, 0, 0.5), Vector3d(-0.4, 0.2, -0.3)}) {
    const Arm arm = arm_to(shoulder);
    EXPECT_LE(arm.wrist_flexion, limits.high[wrist_flexion]);
    EXPECT_GE(arm.wrist_flexion, limits.low[wrist_flexion]);
    EXPECT_LE(arm.wrist_deviation, limits.high[wrist_deviation]);
    EXPECT_GE(arm.wrist_deviation, limits.low[wrist_deviation]);
  }
}

// The angles mean what they mean for the skeleton: its forearm ends at the elbow.
TEST(Arm, TheSkeletonsForearmLeadsToTheElbow) {
  const Arm arm = arm_to({0.15, -0.4, 0.25});
  HandPose pose = HandPose::Zero();
  pose[wrist_flexion] = arm.wrist_flexion;
  pose[wrist_deviation] = arm.wrist_deviation;
  const Vector3d elbow = skeleton_of(mean_anatomy(), pose).hand_from_forearm *
                         Vector3d(0, -forearm_bone(mean_anatomy()), 0);
  EXPECT_LT((elbow - arm.elbow).norm(), 1e-9);
}

// From the elbow to the shoulder, closed but for its poles, normals outwards.
TEST(UpperArm, ReachesFromTheElbowToTheShoulder) {
  const HandAnatomy anatomy = mean_anatomy();
  const UpperArm upper(anatomy, true);
  const Arm arm = arm_to({0.15, -0.4, 0.25});
  PosedSurface posed;
  upper.pose(arm, posed);
  ASSERT_EQ(posed.positions.size(), upper.size());
  const Vector3d along = (arm.shoulder - arm.elbow).normalized();
  double nearest = 1;
  double farthest = 0;
  for (const Eigen::Vector3f& point : posed.positions) {
    const double at = (point.cast<double>() - arm.elbow).dot(along);
    nearest = std::min(nearest, at);
    farthest = std::max(farthest, at);
  }
  EXPECT_LT(nearest, -0.03);
  EXPECT_GT(farthest, upper_arm_bone(anatomy) + 0.04);
  const Eigen::Vector3f middle = (0.5 * (arm.elbow + arm.shoulder)).cast<float>();
  for (const auto& triangle : upper.triangles()) {
    const Eigen::Vector3f& a = posed.positions[triangle[0]];
    const Eigen::Vector3f normal =
        (posed.positions[triangle[1]] - a).cross(posed.positions[triangle[2]] - a);
    if (normal.norm() < 1e-9F) continue;  // at the poles
    EXPECT_GT(normal.dot(posed.normals[triangle[0]]), 0) << "counter-clockwise from outside";
    EXPECT_GT(normal.dot(a - middle), 0);
  }
}

}  // namespace
}  // namespace armsreach::sim
