#include "devices/sim/holding.hpp"

#include <gtest/gtest.h>

namespace armsreach::sim {
namespace {

Pose standing(const PlacedThing& placed) { return placed.world_from_thing; }

World world_with_two_things() {
  World world;
  world.things.push_back({"stone", {{1, 0, 0, 0}, {5, 5, 5}}, {}, false});
  world.things.push_back({"hammer", {{1, 0, 0, 0}, {1, 0, 0}}, {}, true});
  return world;
}

HandKey key(double time, const Eigen::Vector3d& at, const std::string& hold, double turn = 0) {
  HandKey made;
  made.time = time;
  made.gesture = Gesture::grasp;
  made.at = at;
  made.turn = {0, 0, turn};
  made.hold = hold;
  return made;
}

HandDescription hand_in(HandFrame frame, std::vector<HandKey> keys) {
  HandDescription hand;
  hand.frame = frame;
  hand.keys = std::move(keys);
  return hand;
}

double apart(const Pose& a, const Pose& b) { return (a.inverse() * b).log().norm(); }

TEST(Holding, AThingGoesWithTheHandAndStaysWhereItIsLetGo) {
  const World world = world_with_two_things();
  const std::vector<HandActor> actors{
      HandActor(hand_in(HandFrame::world, {key(1, {1, 0, 0}, ""), key(2, {1, 0.1, 0}, "hammer"),
                                           key(3, {1, 1, 0.5}, "hammer", 1),
                                           key(4, {2, 1, 0}, "", 0.5), key(5, {0, 0, 0}, "")}))};
  const Holding holding(world, actors, [](double) { return Pose(); });
  const auto hammer = [&](double time) {
    const auto all = holding.at(time);
    EXPECT_EQ(all.size(), 1U);  // the stone is never held
    EXPECT_EQ(all.front().thing, 1U);
    return standing(all.front());
  };
  const Pose first = world.things[1].world_from_thing;
  EXPECT_LT(apart(hammer(0), first), 1e-12);
  EXPECT_LT(apart(hammer(1.99), first), 1e-12);
  EXPECT_LT(apart(hammer(2), first), 1e-9);  // without a jump
  // Fast in the hand all the while.
  const auto in_hand = [&](double time) {
    return actors[0].world_from_hand(time, {}).inverse() * hammer(time);
  };
  for (const double time : {2.3, 2.9, 3.0, 3.7, 4.0})
    EXPECT_LT(apart(in_hand(time), in_hand(2)), 1e-9);
  EXPECT_GT(apart(hammer(4), first), 0.5);
  EXPECT_LT(apart(hammer(4.5), hammer(4)), 1e-9);
  EXPECT_LT(apart(hammer(100), hammer(4)), 1e-9);
}

TEST(Holding, FromHandToHand) {
  const World world = world_with_two_things();
  const std::vector<HandActor> actors{
      HandActor(hand_in(HandFrame::world, {key(1, {1, 0, 0}, "hammer"), key(2, {1, 1, 0}, "")})),
      HandActor(
          hand_in(HandFrame::camera, {key(2, {0, 0, 0.5}, "hammer"), key(3, {0.1, 0, 0.5}, "")}))};
  // The camera walks along x.
  const Holding holding(world, actors, [](double t) {
    return Pose(Eigen::Quaterniond::Identity(), {t, 0, 0});
  });
  const auto hammer = [&](double time) { return standing(holding.at(time).front()); };
  EXPECT_NEAR(hammer(2).translation().y(), 1, 1e-9);
  EXPECT_LT(apart(hammer(2), hammer(2 - 1e-9)), 1e-6);
  // 1 m with the camera, 0.1 m before it.
  EXPECT_LT((hammer(3).translation() - hammer(2).translation() - Eigen::Vector3d(1.1, 0, 0)).norm(),
            1e-9);
}

}  // namespace
}  // namespace armsreach::sim
