#include "devices/sim/hand/grip.hpp"

#include <array>

#include <gtest/gtest.h>

#include "devices/sim/hand/hand_surface.hpp"

namespace armsreach::sim {
namespace {

// How far the skin is from a handle, by finger; negative inside.
struct Clearance {
  std::array<double, 5> fingers;
  double palm;
};

Clearance clearance(const HandSurface& surface, double diameter) {
  const HandPose pose = pose_around(surface.anatomy(), diameter);
  PosedSurface posed;
  surface.pose(skeleton_of(surface.anatomy(), pose), posed);
  const Pose handle_from_hand = hand_from_handle(surface.anatomy(), diameter).inverse();
  Clearance nearest{{1, 1, 1, 1, 1}, 1};
  for (std::size_t i = 0; i < posed.positions.size(); ++i) {
    const Eigen::Vector3d p = handle_from_hand * Eigen::Vector3d(posed.positions[i].cast<double>());
    const double gap = p.tail<2>().norm() - 0.5 * diameter;
    const Bone bone = surface.bone_of(i);
    const bool phalanx = bone == 2 || bone == 3 || (bone > 5 && bone < 25 && bone % 5 != 0);
    double& place = phalanx ? nearest.fingers[bone < 5 ? 0 : bone / 5] : nearest.palm;
    place = std::min(place, gap);
  }
  return nearest;
}

TEST(Grip, ClosesAroundHandlesOfEveryThickness) {
  HandSurfaceOptions options;
  options.forearm = 0.05;
  options.cell = 0.0045;
  for (const std::uint64_t seed : {2U, 5U, 11U}) {
    const HandSurface surface(random_anatomy(seed), options);
    for (const double diameter : {0.03, 0.045, 0.06, 0.075}) {
      const Clearance gaps = clearance(surface, diameter);
      for (const double gap : gaps.fingers) {
        // Bones' flesh is taken as round when it closes: pads stand out by some millimetres, which
        // real ones give way by.
        EXPECT_GT(gap, -0.006) << "person " << seed << ", handle of " << diameter;
        EXPECT_LT(gap, 0.02) << "person " << seed << ", handle of " << diameter;
      }
      // The ball of the thumb gives way most.
      EXPECT_GT(gaps.palm, -0.009) << "person " << seed << ", handle of " << diameter;
      EXPECT_LT(gaps.palm, 0.006) << "person " << seed << ", handle of " << diameter;
    }
  }
}

TEST(Grip, TheThickerTheWider) {
  const HandAnatomy anatomy = mean_anatomy();
  double before = 10;
  for (const double diameter : {0.03, 0.045, 0.06, 0.075}) {
    const HandPose pose = pose_around(anatomy, diameter);
    double curl = 0;
    for (const Finger finger : kFingers) {
      for (const FingerAngle angle : {FingerAngle::mcp, FingerAngle::pip, FingerAngle::dip})
        curl += pose[angle_index(finger, angle)] / 4;
    }
    EXPECT_LT(curl, before);
    before = curl;
    EXPECT_EQ(pose, within_limits(pose));
  }
}

}  // namespace
}  // namespace armsreach::sim
