#include "devices/sim/hand/skeleton.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "devices/sim/random.hpp"

namespace armsreach::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

HandPose random_pose(std::uint64_t seed) {
  Random random(seed);
  HandPose pose;
  for (Eigen::Index i = 0; i < hand_angle_count; ++i)
    pose[i] = random.uniform(hand_limits().low[i], hand_limits().high[i]);
  return pose;
}

double gap(const HandSkeleton& skeleton, HandJoint a, HandJoint b) {
  return (skeleton[a].translation() - skeleton[b].translation()).norm();
}

TEST(HandSkeleton, BonesKeepTheirLengthsInEveryPosture) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const HandAnatomy anatomy = random_anatomy(seed);
    const HandSkeleton skeleton = skeleton_of(anatomy, random_pose(seed));
    for (int part = 0; part < 3; ++part) {
      const std::size_t i = static_cast<std::size_t>(part);
      EXPECT_NEAR(gap(skeleton, joint_of(Finger::thumb, part), joint_of(Finger::thumb, part + 1)),
                  anatomy.thumb.lengths[i], 1e-12);
    }
    for (const Finger finger : kFingers) {
      const FingerAnatomy& one = anatomy.fingers[static_cast<std::size_t>(finger) - 1];
      EXPECT_NEAR(gap(skeleton, joint_of(finger, 0), joint_of(finger, 1)),
                  (one.knuckle - one.base).norm(), 1e-12);
      for (int part = 1; part < 4; ++part) {
        EXPECT_NEAR(gap(skeleton, joint_of(finger, part), joint_of(finger, part + 1)),
                    one.lengths[static_cast<std::size_t>(part) - 1], 1e-12);
      }
    }
  }
}

TEST(HandSkeleton, StraightFingersPointAlongYWithPadsInThePalmsDirection) {
  const HandSkeleton skeleton = skeleton_of(mean_anatomy(), HandPose::Zero());
  for (const Finger finger : kFingers) {
    for (int part = 1; part <= 4; ++part) {
      const Eigen::Matrix3d turn = skeleton[joint_of(finger, part)].rotation_matrix();
      EXPECT_LT((turn - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    }
  }
  const Eigen::Vector3d tip = skeleton[HandJoint::middle_tip].translation();
  EXPECT_NEAR(tip.y(), mean_anatomy().length(), 1e-12);
}

// Angles add up along a finger, towards the palm.
TEST(HandSkeleton, FlexionBendsTowardsThePalm) {
  HandPose pose = HandPose::Zero();
  pose[angle_index(Finger::index, FingerAngle::mcp)] = 20 * kDegree;
  pose[angle_index(Finger::index, FingerAngle::pip)] = 30 * kDegree;
  pose[angle_index(Finger::index, FingerAngle::dip)] = 40 * kDegree;
  const HandSkeleton skeleton = skeleton_of(mean_anatomy(), pose);
  const Eigen::Vector3d last =
      skeleton[HandJoint::index_distal].rotation() * Eigen::Vector3d(0, 1, 0);
  EXPECT_LT((last - Eigen::Vector3d(0, 0, 1)).norm(), 1e-12);  // 90 degrees in all
}

TEST(HandSkeleton, SpreadIsPositiveTowardsTheThumb) {
  HandPose pose = HandPose::Zero();
  pose[angle_index(Finger::ring, FingerAngle::spread)] = 10 * kDegree;
  const HandSkeleton skeleton = skeleton_of(mean_anatomy(), pose);
  EXPECT_GT((skeleton[HandJoint::ring_tip].translation() -
             skeleton[HandJoint::ring_proximal].translation())
                .x(),
            0.01);
}

TEST(HandSkeleton, TheThumbPointsWhereItsAnglesSay) {
  HandPose pose = HandPose::Zero();
  pose[thumb_radial] = 60 * kDegree;
  pose[thumb_palmar] = 30 * kDegree;
  for (const double twist : {0.0, 20.0, 60.0}) {
    pose[thumb_twist] = twist * kDegree;
    const Pose bone = skeleton_of(mean_anatomy(), pose)[HandJoint::thumb_metacarpal];
    const Eigen::Vector3d along = bone.rotation() * Eigen::Vector3d(0, 1, 0);
    EXPECT_NEAR(std::asin(along.z()), 30 * kDegree, 1e-12);
    EXPECT_NEAR(std::atan2(along.x(), along.y()), 60 * kDegree, 1e-12);
  }
}

TEST(HandSkeleton, MirroringTwiceGivesTheSamePose) {
  const HandSkeleton skeleton = skeleton_of(random_anatomy(4), random_pose(4));
  const Eigen::Vector3d mirror(-1, 1, 1);
  const Eigen::Vector3d point(0.01, 0.02, 0.03);
  for (const Pose& joint : skeleton.hand_from_joint) {
    EXPECT_LT((mirrored(mirrored(joint)).inverse() * joint).log().norm(), 1e-12);
    // The mirror image of a point that goes with the joint.
    const Eigen::Vector3d image = mirror.cwiseProduct(joint * point);
    EXPECT_LT((mirrored(joint) * Eigen::Vector3d(mirror.cwiseProduct(point)) - image).norm(),
              1e-12);
  }
}

TEST(HandAnatomy, PeopleSpreadAsPublished) {
  double sum = 0;
  double squares = 0;
  double shortest = 1;
  double longest = 0;
  constexpr int kPeople = 400;
  for (std::uint64_t seed = 1; seed <= kPeople; ++seed) {
    const HandAnatomy anatomy = random_anatomy(seed);
    const double length = anatomy.length();
    sum += length;
    squares += length * length;
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
    EXPECT_GT(anatomy.palm_breadth() / length, 0.36);
    EXPECT_LT(anatomy.palm_breadth() / length, 0.58);
  }
  const double mean = sum / kPeople;
  const double sigma = std::sqrt(squares / kPeople - mean * mean);
  // Women and men together: 187 mm, sigma 11.7 mm; the mean of 400 is good to 0.6 mm, and bones
  // vary one by one besides.
  EXPECT_NEAR(mean, 0.187, 0.004);
  EXPECT_NEAR(sigma, 0.0117, 0.004);
  EXPECT_GT(shortest, 0.15);
  EXPECT_LT(longest, 0.225);
}

TEST(HandAnatomy, TheSeedIsThePerson) {
  EXPECT_EQ(random_anatomy(7).length(), random_anatomy(7).length());
  EXPECT_NE(random_anatomy(7).length(), random_anatomy(8).length());
}

TEST(HandPose, LimitsHoldAndBlendsGoFromOneToTheOther) {
  const HandPose wild = HandPose::Constant(10);
  EXPECT_EQ(within_limits(wild), hand_limits().high);
  EXPECT_EQ(within_limits(-wild), hand_limits().low);
  const HandPose a = random_pose(1);
  const HandPose b = random_pose(2);
  EXPECT_EQ(blend(a, b, 0), a);
  EXPECT_LT((blend(a, b, 1) - b).norm(), 1e-12);
  EXPECT_LT((blend(a, b, 0.25) - (0.75 * a + 0.25 * b)).norm(), 1e-12);
}

}  // namespace
}  // namespace armsreach::sim
