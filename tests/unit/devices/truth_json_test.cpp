#include "devices/truth_json.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/gimbal_lists.hpp"
#include "devices/gimbal_yaml.hpp"
#include "devices/rig_yaml.hpp"

namespace armsreach {
namespace {

using ::testing::HasSubstr;

const Pose kPose(Eigen::Quaterniond(0.1, 0.2, -0.3, 0.9), {1.0 / 3, -2, 1e-7});

TruthLine full_line() {
  TruthLine line;
  line.time = 1'234'567'891;
  line.truth.world_from_camera = kPose;
  line.truth.gimbal = GimbalState{line.time, {0.1, -0.2, 0.3}, {1, 2, 3}};
  line.truth.things = {{"hammer", 3, kPose}};
  TrueHand hand;
  hand.name = "right hand";
  hand.mask = 7;
  hand.gesture = "point";
  hand.world_from_joint.fill(kPose);
  line.truth.hands = {hand};
  line.truth.markers = {{"square", {0.1, 0.2, 0.3}, 0.5}};
  line.truth.contacts = {{"hammer", "right hand"}};
  line.masks_file = "masks/1.png";
  return line;
}

Result<std::vector<TruthLine>> read(const std::string& text) {
  std::istringstream in(text);
  return read_truth_lines(in, "truth.jsonl");
}

std::string written(const TruthLine& line) {
  std::ostringstream out;
  write_truth_line(out, line);
  return out.str();
}

TEST(TruthJson, ComesBackAsItWasWritten) {
  const std::string text = written(full_line());
  const auto lines = read(text);
  ASSERT_TRUE(lines.ok()) << lines.error().message();
  ASSERT_EQ(lines->size(), 1U);
  // Everything is in the text, so that the same text again means the same truth again.
  EXPECT_EQ(written(lines->front()), text);
  EXPECT_EQ(lines->front().time, 1'234'567'891);
  EXPECT_EQ(lines->front().truth.hands[0].gesture, "point");
  EXPECT_EQ(lines->front().truth.things[0].world_from_thing.translation(), kPose.translation());
}

TEST(TruthJson, NamesTheLineThatIsWrong) {
  const std::string good = written(full_line());
  const auto broken = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return good + text.replace(at, from.size(), to);
  };
  for (const std::string& text :
       {broken("\"t\":1", "\"tt\":1"), broken("\"t\":1", "\"t\":null,\"x\":1"),
        broken("\"mask\":3", "\"mask\":\"three\""), broken("translation", "transl"),
        broken("\"contacts\":[[", "\"contacts\":[\"a\",["), good + "{}\n", good + "[1,\n",
        good + good}) {
    const auto lines = read(text);
    ASSERT_FALSE(lines.ok()) << text;
    EXPECT_EQ(lines.error().where, "truth.jsonl:2");
  }
}

TEST(GimbalLists, StatesComeBackAsTheyWere) {
  std::ostringstream out;
  const GimbalState state{2'000'000'001, {1.0 / 3, -0.2, 1e-9}, {0, 5.2, -1}};
  write_gimbal_state(out, state);
  std::istringstream in("# a comment\n" + out.str());
  const auto states = read_gimbal_states(in, "gimbal.txt");
  ASSERT_TRUE(states.ok()) << states.error().message();
  ASSERT_EQ(states->size(), 1U);
  EXPECT_EQ(states->front().time, state.time);
  EXPECT_EQ(states->front().angles, state.angles);
  EXPECT_EQ(states->front().rates, state.rates);
  for (const char* wrong : {"1 2 3", "1 2 3 4 5 6 7 8", "1 2 3 nan 5 6 7", "9e9 0 0 0 0 0 0",
                            "2 0 0 0 0 0 0\n1 0 0 0 0 0 0"}) {
    std::istringstream bad(wrong);
    EXPECT_FALSE(read_gimbal_states(bad, "gimbal.txt").ok()) << wrong;
  }
}

TEST(RigYaml, AGimbalComesBackAsItWas) {
  RigSpec rig;
  rig.sensors.emplace_back();
  RigSensorSpec& sensor = rig.sensors[0];
  sensor.source = *parse_source_spec("tum:.");
  sensor.rig_from_sensor = kPose;
  GimbalModel model;
  model.order = {GimbalAxis::tilt, GimbalAxis::pan, GimbalAxis::roll};
  model.offsets[1] = {0, 0.01, 0.02};
  model.mount_from_base = kPose;
  model.lag = 0.05;
  sensor.gimbal = model;
  sensor.gimbal_states = "gimbal.txt";
  std::ostringstream out;
  write_rig_yaml(out, rig);
  std::istringstream in(out.str());
  const auto again = read_rig_yaml(in, "rig.yaml");
  ASSERT_TRUE(again.ok()) << again.error().message();
  const RigSensorSpec& read = again->sensors.at(0);
  EXPECT_EQ(read.name, "main");
  EXPECT_EQ(text_of(read.source), "tum:.");
  EXPECT_LT((read.rig_from_sensor.inverse() * kPose).log().norm(), 1e-12);
  ASSERT_TRUE(read.gimbal.has_value());
  EXPECT_EQ(read.gimbal->order, model.order);
  EXPECT_EQ(read.gimbal->offsets[1], model.offsets[1]);
  EXPECT_LT((read.gimbal->upper - model.upper).norm(), 1e-12);
  EXPECT_EQ(read.gimbal->lag, 0.05);
  EXPECT_EQ(read.gimbal_states, "gimbal.txt");
}

TEST(RigYaml, WrongGimbalsAreRefused) {
  const struct {
    const char* gimbal;
    const char* says;
  } wrong[] = {{"{order: [pan, pan, roll]}", "'order'"},
               {"{ordr: 1}", "'ordr'"},
               {"{lower_deg: [1, -1, -1]}", "rest"},
               {"{fastest_deg: [0, 1, 1]}", "above 0"},
               {"{offsets: [[0, 0, 0]]}", "'offsets'"},
               {"{lag: -1}", "'lag'"},
               {"3", "not a map"}};
  for (const auto& one : wrong) {
    std::istringstream in("sensors: [{name: a, source: 'tum:.', gimbal_states: g.txt, gimbal: " +
                          std::string(one.gimbal) + "}]");
    const auto rig = read_rig_yaml(in, "rig.yaml");
    ASSERT_FALSE(rig.ok()) << one.gimbal;
    EXPECT_THAT(rig.error().what, HasSubstr(one.says));
  }
}

}  // namespace
}  // namespace armsreach
