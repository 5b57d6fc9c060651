// The transition table: read from YAML, refused when it is wrong, walked through in time.
#include "vision/gesture/gesture_table.hpp"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

using ::testing::HasSubstr;

Result<GestureTable> read(const std::string& text) {
  std::istringstream in(text);
  return read_gesture_table(in, "table.yaml");
}

GestureTable shipped() {
  std::ifstream in(ARMSREACH_SOURCE_DIR "/assets/gestures/transitions.yaml");
  auto table = read_gesture_table(in, "transitions.yaml");
  EXPECT_TRUE(table.ok()) << table.error().message();
  return *table;
}

// Shows a gesture for so many seconds at 30 Hz; returns the actions.
std::vector<Action> show(GestureMachine& machine, Timestamp& time, const std::string& gesture,
                         double seconds) {
  std::vector<Action> actions;
  for (const Timestamp end = time + timestamp_from_seconds(seconds); time < end;
       time += 33'333'333) {
    if (const auto action = machine.step(gesture, time)) actions.push_back(*action);
  }
  return actions;
}

TEST(GestureTable, AHandSelectsWhereItHasPointedAndThenAcceptsOrRejects) {
  const GestureTable table = shipped();
  GestureMachine machine(table);
  Timestamp time = 0;
  EXPECT_EQ(machine.state().name, "away");
  EXPECT_TRUE(show(machine, time, "point", 0.5).empty());
  EXPECT_TRUE(machine.state().cursor);
  EXPECT_THAT(show(machine, time, "L", 1), ::testing::ElementsAre(Action::select));
  EXPECT_THAT(show(machine, time, "open", 1), ::testing::ElementsAre(Action::accept));
  EXPECT_THAT(show(machine, time, "fist", 1), ::testing::ElementsAre(Action::reject));
  EXPECT_TRUE(show(machine, time, "grasp", 1).empty());
  EXPECT_TRUE(machine.state().direction);
  EXPECT_TRUE(show(machine, time, kGone, 1).empty());
  EXPECT_EQ(machine.state().name, "away");
}

TEST(GestureTable, AnLOutOfNowhereSelectsNothing) {
  const GestureTable table = shipped();
  GestureMachine machine(table);
  Timestamp time = 0;
  EXPECT_TRUE(show(machine, time, "open", 0.5).empty());
  EXPECT_TRUE(show(machine, time, "L", 1).empty());
}

TEST(GestureTable, AStateOutlastsAShortDoubt) {
  const GestureTable table = shipped();
  GestureMachine machine(table);
  Timestamp time = 0;
  show(machine, time, "point", 0.5);
  show(machine, time, kNothing, 0.4);
  EXPECT_EQ(machine.state().name, "pointing");
  show(machine, time, kNothing, 0.4);
  EXPECT_EQ(machine.state().name, "idle");
}

TEST(GestureTable, AGestureMustLast) {
  const GestureTable table = shipped();
  GestureMachine machine(table);
  Timestamp time = 0;
  show(machine, time, "point", 0.5);
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(show(machine, time, "L", 0.15).empty());
    show(machine, time, "point", 0.1);
  }
}

TEST(GestureTable, WhatIsWrongIsNamed) {
  const std::string states = "states: [{name: a}, {name: b}]\n";
  const auto complaint = [](const std::string& text) {
    const auto table = read(text);
    return table.ok() ? std::string("accepted") : table.error().message();
  };
  EXPECT_THAT(complaint("states: [{name: a}]"), HasSubstr("'transitions' must be a list"));
  EXPECT_THAT(complaint("[]"), HasSubstr("is not a map"));
  EXPECT_THAT(complaint("states: [{name: a, colour: red}]\ntransitions: []"),
              HasSubstr("unknown key 'states[0].colour'"));
  EXPECT_THAT(complaint("states: [{name: a}, {name: a}]\ntransitions: []"),
              HasSubstr("two states 'a'"));
  EXPECT_THAT(complaint(states + "transitions: [{from: a, on: fist, to: c}]"),
              HasSubstr("'transitions[0].to' names the state 'c'"));
  EXPECT_THAT(complaint(states + "transitions: [{from: a, on: fist, to: b, after: -1}]"),
              HasSubstr("'transitions[0].after'"));
  EXPECT_THAT(complaint(states + "transitions: [{from: a, on: fist, to: b, after: .nan}]"),
              HasSubstr("'transitions[0].after'"));
  EXPECT_THAT(complaint(states + "transitions: [{from: a, on: fist, to: b, do: dance}]"),
              HasSubstr("select, accept or reject"));
  EXPECT_THAT(complaint("states: ["), HasSubstr("not readable as YAML"));
}

}  // namespace
}  // namespace armsreach::gesture
