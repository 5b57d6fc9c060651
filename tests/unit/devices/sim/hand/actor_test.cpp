#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "devices/sim/hand/hand_actor.hpp"

namespace armsreach::sim {
namespace {

HandDescription points_then_opens(HandFrame frame, bool left) {
  HandDescription hand;
  hand.left = left;
  hand.frame = frame;
  HandKey key;
  key.time = 1;
  key.gesture = Gesture::point;
  key.at = {0, 0, 0.4};
  hand.keys.push_back(key);
  key.time = 3;
  key.gesture = Gesture::open;
  key.at = {0.2, 0.1, 0.6};
  key.turn = {0, 0, 0.5};
  hand.keys.push_back(key);
  return hand;
}

const Pose kWorldFromCamera(
    Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized())),
    {1, -2, 0.5});

TEST(HandActor, RestsBeforeAndAfterItsKeysAndIsSmoothBetween) {
  const HandActor actor(points_then_opens(HandFrame::camera, false));
  EXPECT_EQ(actor.pose(0), actor.pose(1));
  EXPECT_EQ(actor.pose(3), actor.pose(10));
  EXPECT_EQ(actor.pose(1), pose_of(Gesture::point, actor.anatomy()));
  // The eased middle is the middle; no velocity at the ends.
  EXPECT_LT((actor.pose(2) - blend(actor.pose(1), actor.pose(3), 0.5)).norm(), 1e-12);
  EXPECT_LT((actor.pose(1.01) - actor.pose(1)).norm(), 1e-5);
  EXPECT_LT((actor.pose(2.99) - actor.pose(3)).norm(), 1e-5);
}

TEST(HandActor, GoesWithTheCameraOrStaysInTheWorld) {
  const HandActor with_camera(points_then_opens(HandFrame::camera, false));
  const HandActor in_world(points_then_opens(HandFrame::world, false));
  for (const double time : {0.0, 1.7, 5.0}) {
    const Pose seen =
        kWorldFromCamera.inverse() * with_camera.world_from_hand(time, kWorldFromCamera);
    EXPECT_LT((seen.inverse() * with_camera.world_from_hand(time, {})).log().norm(), 1e-12);
    EXPECT_LT((in_world.world_from_hand(time, {}).inverse() *
               in_world.world_from_hand(time, kWorldFromCamera))
                  .log()
                  .norm(),
              1e-12);
  }
}

TEST(HandActor, OnAThingItKeepsItsGripWhereverTheThingGoes) {
  HandDescription hand;
  hand.frame = HandFrame::world;
  HandKey key;
  key.at = {0, 0, 1};
  hand.keys.push_back(key);
  key = {};
  key.time = 1;
  key.grip = 0.03;
  key.on = key.hold = "hammer";
  key.at = {-0.15, 0, 0};
  key.turn = {0.4, -0.2, 1.1};
  hand.keys.push_back(key);
  key.time = 3;
  hand.keys.push_back(key);
  const auto world_from_hammer = [](const std::string& thing, double time) {
    EXPECT_EQ(thing, "hammer");
    return Pose(Eigen::Quaterniond(Eigen::AngleAxisd(time, Eigen::Vector3d::UnitX())),
                {time, 0.2 * time, 1});
  };
  for (const bool left : {false, true}) {
    hand.left = left;
    const HandActor actor(hand, {world_from_hammer, {}});
    const auto hammer_from_hand = [&](double time) {
      return world_from_hammer("hammer", time).inverse() * actor.world_from_hand(time, {});
    };
    const Pose grip = hammer_from_hand(1);
    for (const double time : {1.3, 2.0, 2.9, 3.0, 7.0})
      EXPECT_LT((grip.inverse() * hammer_from_hand(time)).log().norm(), 1e-9) << time;
    // The handle is as thick as the fingers are closed: its axis lies before the palm's skin, which
    // is 1.0 to 1.6 cm before the bones.
    const Eigen::Vector3d handle_in_hand = grip.inverse() * key.at;
    EXPECT_NEAR(handle_in_hand.z(), 0.015 + 0.013, 0.004);
    EXPECT_GT(handle_in_hand.y(), 0.04);  // before the palm, not the wrist
    // On the way it leaves the world's place without a jump.
    EXPECT_LT(
        (actor.world_from_hand(0, {}).inverse() * actor.world_from_hand(1e-3, {})).log().norm(),
        1e-5);
  }
}

TEST(HandActor, BeforeTheCameraItShowsItsPalmWithFingersUp) {
  const HandActor actor(points_then_opens(HandFrame::camera, false));
  const Pose camera_from_hand = actor.world_from_hand(0, {});
  EXPECT_LT(
      (camera_from_hand.rotation() * Eigen::Vector3d(0, 1, 0) - Eigen::Vector3d(0, -1, 0)).norm(),
      1e-12);
  EXPECT_LT(
      (camera_from_hand.rotation() * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(0, 0, -1)).norm(),
      1e-12);
  // Its palm's middle is where the key says, three quarters of the way to the knuckle.
  const Eigen::Vector3d palm(0, 0.75 * actor.anatomy().fingers[1].knuckle.y(), 0);
  EXPECT_LT((camera_from_hand * palm - Eigen::Vector3d(0, 0, 0.4)).norm(), 1e-12);
}

TEST(HandActor, TruthNamesGesturesOnlyWhereTheyAreMade) {
  const HandActor actor(points_then_opens(HandFrame::camera, false));
  EXPECT_EQ(actor.truth(0.5, {}).gesture, Gesture::point);
  EXPECT_EQ(actor.truth(2, {}).gesture, std::nullopt);
  EXPECT_EQ(actor.truth(3.5, {}).gesture, Gesture::open);
}

TEST(HandActor, TruthJointsAreInTheWorldAndMirroredForALeftHand) {
  const HandActor right(points_then_opens(HandFrame::world, false));
  const HandActor left(points_then_opens(HandFrame::world, true));
  const HandTruth r = right.truth(0, {});
  const HandTruth l = left.truth(0, {});
  const Pose world_from_hand = right.world_from_hand(0, {});
  EXPECT_LT((world_from_hand.inverse() * r.world_from_joint[0]).log().norm(), 1e-12);
  const std::size_t tip = static_cast<std::size_t>(HandJoint::index_tip);
  const Eigen::Vector3d right_tip =
      world_from_hand.inverse() * r.world_from_joint[tip].translation();
  const Eigen::Vector3d left_tip =
      world_from_hand.inverse() * l.world_from_joint[tip].translation();
  EXPECT_LT((left_tip - Eigen::Vector3d(-right_tip.x(), right_tip.y(), right_tip.z())).norm(),
            1e-12);
}

}  // namespace
}  // namespace armsreach::sim
