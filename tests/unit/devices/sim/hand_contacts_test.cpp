#include "devices/sim/hand_contacts.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "devices/open.hpp"
#include "devices/sim/hand/hand_painter.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/truth.hpp"

namespace armsreach::sim {
namespace {

using Touches = std::vector<std::pair<int, HandPart>>;

// A board whose upper side is at z = 0.
World with_board() {
  World world;
  Thing thing;
  thing.name = "board";
  world.things.push_back(thing);
  Part part;
  part.thing = 0;
  part.shape = Box{{1, 1, 0.02}};
  part.thing_from_part = Pose(Eigen::Quaterniond::Identity(), {0, 0, -0.02});
  world.parts.push_back(part);
  return world;
}

// Where a pointing hand, palm down, leaves its lowest skin at this height.
Touches touches_at(double height, double pitch) {
  HandDescription hand;
  hand.frame = HandFrame::world;
  HandKey key;
  key.gesture = Gesture::point;
  key.turn = {pitch, 3.14159265358979, 0};
  hand.keys.push_back(key);
  HandPainter painter({hand});
  painter.set_time(0, Pose());
  const FeltSkin felt = painter.skin(0);
  std::vector<Eigen::Vector3f> skin(felt.points.begin(), felt.points.end());
  float lowest = 1;
  for (const Eigen::Vector3f& point : skin) lowest = std::min(lowest, point.z());
  for (Eigen::Vector3f& point : skin) point.z() += static_cast<float>(height) - lowest;
  return HandContactFinder(with_board()).at(felt.surface, skin, {Pose()});
}

TEST(HandContacts, AreOfTheSkinNotOfTheScript) {
  EXPECT_TRUE(touches_at(0.004, 0.9).empty()) << "4 mm above";
  const Touches touches = touches_at(-0.001, 0.9);
  EXPECT_EQ(touches, (Touches{{0, HandPart::index}})) << "the pointing finger's tip, and no other";
}

TEST(HandContacts, AHandThatLiesFlatTouchesWithMoreThanOneFinger) {
  EXPECT_GT(touches_at(-0.012, 0).size(), 2U);
}

// Every touch that the truth of a shipped world names is one; holding and touching are two things.
TEST(HandContacts, OfAWorldNameTheFinger) {
  const auto source =
      open_source(*parse_source_spec("sim:assembly,width=32,noise=none,rate=2,frames=8"), {},
                  sim_source_kinds());
  ASSERT_TRUE(source.ok());
  bool index_touched = false;
  for (int i = 0; i < 8; ++i) {
    const FramePtr frame = *(*source)->next();
    const auto touch = [&](const std::string& part) {
      const auto& pairs = frame->truth->contacts;
      return std::find(pairs.begin(), pairs.end(), std::pair(std::string("second baton"), part)) !=
             pairs.end();
    };
    const TrueHand& left = frame->truth->hands[1];
    EXPECT_EQ(left.holds, i >= 4 ? "second baton" : "") << 0.5 * i << " s";
    if (i >= 4) index_touched = index_touched || touch("left hand/index");
    if (i <= 1) {
      EXPECT_FALSE(touch("left hand/index")) << 0.5 * i << " s";
    }
  }
  EXPECT_TRUE(index_touched);
}

// The gloved forefinger presses the tea packet at 4.2 s for a second, and nothing before.
TEST(HandContacts, TheHapticHandReallyTouches) {
  const auto source = open_source(
      *parse_source_spec("sim:haptic-table,sensor=main,width=32,noise=none,rate=2,frames=11"), {},
      sim_source_kinds());
  ASSERT_TRUE(source.ok());
  const std::pair<std::string, std::string> press("tea packet", "right hand/index");
  for (int i = 0; i < 11; ++i) {
    const FramePtr frame = *(*source)->next();
    const auto& pairs = frame->truth->contacts;
    const bool pressed = std::find(pairs.begin(), pairs.end(), press) != pairs.end();
    const double time = 0.5 * i;
    if (time < 4) {
      EXPECT_TRUE(pairs.empty()) << time;
    }
    if (time >= 4.2 && time <= 5.2) {
      EXPECT_TRUE(pressed) << time;
    }
    EXPECT_TRUE(frame->truth->hands[0].holds.empty());
  }
}

}  // namespace
}  // namespace armsreach::sim
