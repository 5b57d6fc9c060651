#include "devices/sim/hand/gesture.hpp"

#include <gtest/gtest.h>

#include "devices/sim/hand/contact.hpp"
#include "devices/sim/hand/skeleton.hpp"

namespace armsreach::sim {
namespace {

// Between the pads of the last bones.
double pad_gap(const HandAnatomy& anatomy, const HandPose& pose, Finger finger) {
  const HandSkeleton skeleton = skeleton_of(anatomy, pose);
  double nearest = 1;
  for (const double a : {0.5, 0.6, 0.7, 0.8}) {
    for (const double b : {0.5, 0.6, 0.7, 0.8}) {
      const SkinPoint thumb = skin_point(anatomy, skeleton, {Finger::thumb, 2, a, {0, 0, 1}});
      const SkinPoint other = skin_point(anatomy, skeleton, {finger, 3, b, {0, 0, 1}});
      nearest = std::min(nearest, (thumb.position - other.position).norm());
    }
  }
  return nearest;
}

double reach(const HandAnatomy& anatomy, const HandPose& pose, Finger finger) {
  const HandSkeleton skeleton = skeleton_of(anatomy, pose);
  return skeleton[tip_of(finger)].translation().y() -
         skeleton[joint_of(finger, 1)].translation().y();
}

TEST(Gesture, EveryPostureIsWithinTheLimits) {
  for (int i = 0; i < kGestureCount; ++i) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const HandPose pose = pose_of(static_cast<Gesture>(i), random_anatomy(seed), seed);
      EXPECT_EQ(pose, within_limits(pose)) << name(static_cast<Gesture>(i)) << ' ' << seed;
    }
  }
}

TEST(Gesture, TheThumbTouchesTheFingerThatTheNumeralNames) {
  const std::vector<std::pair<Gesture, Finger>> touching{{Gesture::pinch, Finger::index},
                                                         {Gesture::six, Finger::little},
                                                         {Gesture::seven, Finger::ring},
                                                         {Gesture::eight, Finger::middle},
                                                         {Gesture::nine, Finger::index}};
  for (const auto& [gesture, finger] : touching) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const HandAnatomy anatomy = random_anatomy(seed);
      const HandPose pose = pose_of(gesture, anatomy, seed);
      EXPECT_LT(pad_gap(anatomy, pose, finger), 0.005) << name(gesture) << " of " << seed;
      for (const Finger other : kFingers) {
        if (other == finger) continue;
        EXPECT_GT(pad_gap(anatomy, pose, other), 0.012) << name(gesture) << " of " << seed;
      }
    }
  }
}

TEST(Gesture, FingersAreUpOrFolded) {
  using enum Finger;
  const std::vector<std::pair<Gesture, std::vector<Finger>>> up{
      {Gesture::point, {index}},
      {Gesture::L, {index}},
      {Gesture::open, {index, middle, ring, little}},
      {Gesture::fist, {}},
      {Gesture::one, {index}},
      {Gesture::two, {index, middle}},
      {Gesture::three, {index, middle}},
      {Gesture::four, {index, middle, ring, little}},
      {Gesture::five, {index, middle, ring, little}},
      {Gesture::six, {index, middle, ring}},
      {Gesture::seven, {index, middle, little}},
      {Gesture::eight, {index, ring, little}},
      {Gesture::nine, {middle, ring, little}}};
  const HandAnatomy anatomy = random_anatomy(3);
  for (const auto& [gesture, fingers] : up) {
    const HandPose pose = pose_of(gesture, anatomy);
    for (const Finger finger : kFingers) {
      const auto& lengths = anatomy.fingers[static_cast<std::size_t>(finger) - 1].lengths;
      const double length = lengths[0] + lengths[1] + lengths[2];
      const bool is_up = std::count(fingers.begin(), fingers.end(), finger) > 0;
      if (is_up)
        EXPECT_GT(reach(anatomy, pose, finger), 0.85 * length) << name(gesture);
      else
        EXPECT_LT(reach(anatomy, pose, finger), 0.45 * length) << name(gesture);
    }
  }
}

TEST(Gesture, LIsARightAngleAndFourHidesItsThumb) {
  const HandAnatomy anatomy = mean_anatomy();
  const auto thumb_tip = [&](Gesture gesture) {
    return Eigen::Vector3d(
        skeleton_of(anatomy, pose_of(gesture, anatomy))[HandJoint::thumb_tip].translation());
  };
  const double knuckle = anatomy.fingers[0].knuckle.x();
  EXPECT_GT(thumb_tip(Gesture::L).x(), knuckle + 0.05);
  EXPECT_GT(thumb_tip(Gesture::five).x(), knuckle + 0.05);
  EXPECT_LT(thumb_tip(Gesture::four).x(), knuckle);
}

TEST(Gesture, MannersDifferByDegrees) {
  const HandAnatomy anatomy = mean_anatomy();
  const HandPose usual = pose_of(Gesture::two, anatomy);
  const HandPose one = pose_of(Gesture::two, anatomy, 5);
  EXPECT_EQ(one, pose_of(Gesture::two, anatomy, 5));
  EXPECT_GT((one - usual).norm(), 0.02);
  EXPECT_LT((one - usual).cwiseAbs().maxCoeff(), 0.5);
}

TEST(Gesture, NamesGoBothWays) {
  for (int i = 0; i < kGestureCount; ++i) {
    const Gesture gesture = static_cast<Gesture>(i);
    EXPECT_EQ(gesture_named(name(gesture)), gesture);
  }
  EXPECT_FALSE(gesture_named("ten").has_value());
}

}  // namespace
}  // namespace armsreach::sim
