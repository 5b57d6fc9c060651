#include "vision/mono_slam/target_yaml.hpp"

#include <sstream>

#include <gtest/gtest.h>

namespace armsreach::mono_slam {
namespace {

Result<TargetFile> read(const std::string& text) {
  std::istringstream in(text);
  return read_target_yaml(in, "target.yaml");
}

TEST(TargetYaml, MarksComeBackAsTheyWere) {
  TargetFile file;
  for (int i = 0; i < 4; ++i) {
    file.marks.push_back({"patch" + std::to_string(i) + ".pgm", {0.1 * i, -0.07425 * (i % 2), 0}});
  }
  std::ostringstream out;
  write_target_yaml(out, file);
  const auto again = read(out.str());
  ASSERT_TRUE(again) << again.error().message();
  ASSERT_EQ(again->marks.size(), 4U);
  EXPECT_EQ(again->marks[3].patch, "patch3.pgm");
  EXPECT_EQ(again->marks[3].point_in_world, file.marks[3].point_in_world);
}

TEST(TargetYaml, ARectangleComesBackAsItWas) {
  TargetFile file;
  file.rectangle = StartTarget::Rectangle{0.21, 0.1485};
  std::ostringstream out;
  write_target_yaml(out, file);
  const auto again = read(out.str());
  ASSERT_TRUE(again) << again.error().message();
  ASSERT_TRUE(again->rectangle);
  EXPECT_EQ(again->rectangle->height, 0.1485);
}

TEST(TargetYaml, PointsThatDetermineNoPoseAreRefused) {
  const auto points = [](const std::vector<std::string>& places) {
    std::string text = "points:\n";
    for (const std::string& place : places) {
      text += "  - {patch: a.pgm, point_in_world: " + place + "}\n";
    }
    return text;
  };
  EXPECT_TRUE(read(points({"[0, 0, 0]", "[1, 0, 0]", "[0, 1, 0]", "[1, 1, 0]"})));
  for (const auto& places : {std::vector<std::string>(4, "[0, 0, 0]"),
                             {"[0, 0, 0]", "[1, 1, 0]", "[2, 2, 0]", "[3, 3, 0]"},
                             {"[0, 0, 0]", "[1, 0, 0]", "[0, 1, 0]", "[0, 1, 0]"}}) {
    const auto result = read(points(places));
    ASSERT_FALSE(result) << places[3];
    EXPECT_NE(result.error().what.find("on a line"), std::string::npos);
  }
}

TEST(TargetYaml, WhatCannotBeIsAnErrorThatSaysSo) {
  const std::string mark = "{patch: a.pgm, point_in_world: [0, 0, 0]}";
  for (const std::string& text :
       {std::string(), std::string("points: 4"), "points: [" + mark + "]",
        "points: [" + mark + "," + mark + "," + mark + ", {patch: a.pgm}]",
        "points: [" + mark + "," + mark + "," + mark +
            ", {patch: a.pgm, point_in_world: [0, .nan, 0]}]",
        std::string("rectangle: {width: -1, height: 2}"), std::string("rectangle: [1, 2]"),
        std::string("points: ["), std::string("- 1")}) {
    const auto result = read(text);
    ASSERT_FALSE(result) << text;
    EXPECT_EQ(result.error().where, "target.yaml");
    EXPECT_FALSE(result.error().what.empty());
  }
}

}  // namespace
}  // namespace armsreach::mono_slam
