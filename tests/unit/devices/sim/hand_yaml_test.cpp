#include "devices/sim/hand_yaml.hpp"

#include <numbers>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/sim/world_yaml.hpp"
#include "render/assets.hpp"

namespace armsreach::sim {
namespace {

using testing::HasSubstr;

const std::string kScript = R"(hands:
  - {side: left, frame: world, seed: 4, skin: dark, sleeve: "#336699", keys: [
      {t: 0, pose: 7, at: [1, 2, 3]},
      {t: 1.5, pose: L, at: [0, 0, 1], turn_deg: [0, 90, 0], wrist_deg: [10, -5]}], repeat: 2, shoulder: [3, 2, 1]}
)";

Result<std::vector<HandDescription>> read(const std::string& text) {
  std::istringstream in(text);
  return read_hand_script(in, "test.yaml");
}

TEST(HandYaml, ReadsWhatIsThere) {
  const auto hands = read(kScript);
  ASSERT_TRUE(hands.ok()) << hands.error().message();
  ASSERT_EQ(hands->size(), 1U);
  const HandDescription& hand = hands->front();
  EXPECT_TRUE(hand.left);
  EXPECT_EQ(hand.frame, HandFrame::world);
  EXPECT_EQ(hand.seed, 4U);
  EXPECT_EQ(hand.skin, SkinTone::dark);
  EXPECT_TRUE(hand.sleeve);
  EXPECT_LT((hand.sleeve_color - Eigen::Vector3d(0.2, 0.4, 0.6)).norm(), 1e-9);
  ASSERT_EQ(hand.keys.size(), 2U);
  EXPECT_EQ(hand.keys[0].gesture, Gesture::seven);
  EXPECT_EQ(hand.keys[0].at, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(hand.repeat, 2);
  EXPECT_EQ(hand.shoulder, Eigen::Vector3d(3, 2, 1));
  EXPECT_EQ(hand.keys[1].gesture, Gesture::L);
  EXPECT_DOUBLE_EQ(hand.keys[1].turn.y(), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(hand.keys[1].wrist_deviation, -5 * std::numbers::pi / 180);
}

TEST(HandYaml, AGripIsAGraspAroundSomething) {
  const auto hands =
      read("hands: [{side: right, frame: world, keys: [{t: 0, grip: 0.03, at: [0, 0, 0]}]}]");
  ASSERT_TRUE(hands.ok()) << hands.error().message();
  EXPECT_EQ(hands->front().keys[0].gesture, Gesture::grasp);
  EXPECT_EQ(hands->front().keys[0].grip, 0.03);
}

TEST(HandYaml, SaysWhatIsWrong) {
  const auto complaint = [](const std::string& from, const std::string& to) {
    std::string text = kScript;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    const auto hands = read(text.replace(at, from.size(), to));
    return hands.ok() ? std::string("nothing") : hands.error().message();
  };
  EXPECT_THAT(complaint("pose: L", "pose: wave"), HasSubstr("'wave'"));
  EXPECT_THAT(complaint("t: 1.5", "t: 0"), HasSubstr("do not increase"));
  EXPECT_THAT(complaint("side: left", "side: both"), HasSubstr("hands[0].side"));
  EXPECT_THAT(complaint("skin: dark", "skin: green"), HasSubstr("'green'"));
  EXPECT_THAT(complaint("frame: world, ", ""), HasSubstr("'hands[0].frame' is missing"));
  EXPECT_THAT(complaint("at: [1, 2, 3]", "at: [1, 2]"), HasSubstr("hands[0].keys[0].at"));
  EXPECT_THAT(complaint("at: [1, 2, 3]", "at: [1, 2, .nan]"), HasSubstr("finite"));
  EXPECT_THAT(complaint("seed: 4", "sed: 4"), HasSubstr("hands[0].sed"));
  EXPECT_THAT(read("hands: 3").error().message(), HasSubstr("'hands' is not a list"));
  EXPECT_THAT(read("hands: [").error().message(), HasSubstr("not readable"));
  EXPECT_THAT(complaint("pose: 7", "grip: 3"), HasSubstr("grip"));
  EXPECT_FALSE(read("").ok());
  EXPECT_THAT(read("hands: []").error().message(), HasSubstr("'hands' is empty"));
  EXPECT_THAT(complaint("repeat: 2", "repeat: 1"), HasSubstr("hands[0].repeat"));
  EXPECT_THAT(complaint("wrist_deg: [10, -5]", "hold: teapot"), HasSubstr("need a world"));
}

TEST(HandYaml, TheScriptsThatComeWithTheProgramAreSound) {
  const auto tour = read(std::string(render::asset("hands/tour.yaml")));
  ASSERT_TRUE(tour.ok()) << tour.error().message();
  const auto hands = read(std::string(render::asset("hands/gestures.yaml")));
  ASSERT_TRUE(hands.ok()) << hands.error().message();
  // Issue's list: points, L, open, fist, grasp.
  for (const Gesture gesture :
       {Gesture::point, Gesture::L, Gesture::open, Gesture::fist, Gesture::grasp, Gesture::pinch}) {
    EXPECT_TRUE(std::any_of(hands->front().keys.begin(), hands->front().keys.end(),
                            [&](const HandKey& key) { return key.gesture == gesture; }))
        << name(gesture);
  }
}

TEST(HandYaml, TheNumeralsAreAllTenOverAndOver) {
  const auto hands = read(std::string(render::asset("hands/numerals.yaml")));
  ASSERT_TRUE(hands.ok()) << hands.error().message();
  EXPECT_GT(hands->front().repeat, 0);
  for (int numeral = 0; numeral < 10; ++numeral) {
    const auto gesture = gesture_named(std::to_string(numeral));
    EXPECT_TRUE(std::any_of(hands->front().keys.begin(), hands->front().keys.end(),
                            [&](const HandKey& key) { return key.gesture == gesture; }))
        << numeral;
  }
}

TEST(HandYaml, WhatMovesByItselfIsHeldOnIt) {
  const std::string text(render::asset("worlds/assembly.yaml"));
  const auto complaint = [&text](const std::string& key) {
    std::istringstream in(text.substr(0, text.rfind("\nhands:") + 1) +
                          "hands: [{side: right, frame: world, keys: [{t: 0, pose: grasp, at: "
                          "[0, 0, 1], " +
                          key + "}]}]\n");
    const auto world = read_world_yaml(in, "assembly");
    return world.ok() ? std::string("nothing") : world.error().message();
  };
  EXPECT_EQ(complaint("on: hammer, hold: hammer"), "nothing");
  EXPECT_EQ(complaint("on: floor"), "nothing");
  EXPECT_THAT(complaint("hold: hammer"), HasSubstr("hold it with 'on: hammer'"));
  EXPECT_THAT(complaint("on: cutting mat, hold: cutting mat"), HasSubstr("no motion"));
  EXPECT_THAT(complaint("on: anvil"), HasSubstr("'anvil'"));
  EXPECT_THAT(
      read("hands: [{side: left, frame: world, keys: [{t: 0, pose: L, at: [0, 0, 0], on: a}]}]")
          .error()
          .message(),
      HasSubstr("need a world"));
}

TEST(HandYaml, AWorldsHandsHoldThingsOfTheWorld) {
  std::string text(render::asset("worlds/bench.yaml"));
  const auto world_with = [&text](const std::string& thing) {
    std::istringstream in(text +
                          "hands: [{side: right, frame: world, keys: [{t: 0, pose: grasp, at: "
                          "[0, 0, 1], hold: " +
                          thing + "}]}]\n");
    return read_world_yaml(in, "bench");
  };
  const auto good = world_with("mug");
  ASSERT_TRUE(good.ok()) << good.error().message();
  EXPECT_EQ(good->hands.size(), 1U);
  const auto bad = world_with("anvil");
  ASSERT_FALSE(bad.ok());
  EXPECT_THAT(bad.error().message(), HasSubstr("'anvil'"));
}

}  // namespace
}  // namespace armsreach::sim
