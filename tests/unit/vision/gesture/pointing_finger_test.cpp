// The axis of a pointing finger against the bones of the simulated hand that points.
#include "vision/gesture/pointing_finger.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "devices/sim/hand/skeleton.hpp"
#include "simulated_hand.hpp"

namespace armsreach::gesture {
namespace {

using sim::HandJoint;

constexpr double kDegree = std::numbers::pi / 180;

Eigen::Vector2d seen(const Pose& camera_from_hand, const Pose& hand_from_joint) {
  return (camera_from_hand * hand_from_joint.translation()).hnormalized();
}

// rad, 0 upwards, clockwise: of the free part of the index finger in the image.
double true_angle(const sim::HandView& view) {
  const sim::HandAnatomy anatomy = sim::mean_anatomy();
  const auto skeleton = sim::skeleton_of(anatomy, sim::pose_of(sim::Gesture::point, anatomy));
  const Pose camera_from_hand = sim::camera_from_hand(view, anatomy);
  const Eigen::Vector2d along = seen(camera_from_hand, skeleton[HandJoint::index_tip]) -
                                seen(camera_from_hand, skeleton[HandJoint::index_intermediate]);
  return std::atan2(along.x(), -along.y());
}

// Bones do not run in the very middle of the flesh: that, and whole pixels, are within the three
// degrees.
TEST(PointingFinger, LiesAlongTheIndexFingersBones) {
  for (const double turn : {-0.3, 0.0, 0.3}) {
    for (int degrees = -150; degrees <= 180; degrees += 30) {
      sim::HandView view;
      view.turn = turn;
      view.roll = degrees * kDegree;
      const auto blobs = HandFinder().find(test::simulated_hand(sim::Gesture::point, view));
      ASSERT_FALSE(blobs.empty());
      const double truth = true_angle(view);
      // What the templates say may be ten degrees off.
      const auto finger = pointing_finger(blobs[0].readings[0], truth + 10 * kDegree);
      const double error = std::remainder(finger.angle - truth, 2 * std::numbers::pi);
      EXPECT_LT(std::abs(error) / kDegree, 3) << "turn " << turn << ", roll " << degrees;
    }
  }
}

}  // namespace
}  // namespace armsreach::gesture
