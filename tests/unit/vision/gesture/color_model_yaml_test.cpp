#include "vision/gesture/color_model_yaml.hpp"

#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "painted_skin.hpp"
#include "vision/gesture/color_table.hpp"

namespace armsreach::gesture::test {
namespace {

using ::testing::HasSubstr;

Result<ColorModel> read(const std::string& text) {
  std::istringstream in(text);
  return read_color_model(in, "model.yaml");
}

std::string written(const ColorModel& model) {
  std::ostringstream out;
  write_color_model(out, model);
  return out.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string with_rows(const std::string& rows) {
  const std::string luma = "luma: [1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]";
  return "cells: 128\nbackground: {" + luma + ", uv: [[64, 64, 5]]}\nclasses:\n  - {name: skin, " +
         luma + ", uv: " + rows + "}\n";
}

TEST(ColorModelYaml, ComesBackClassifyingAlike) {
  ColorModel model = general_model();
  model.classes[0].name = "skin: \"mine\"";
  model.balance = {1.25F, 1, 0.5F};
  const auto back = read(written(model));
  ASSERT_TRUE(back.ok()) << back.error().message();
  EXPECT_EQ(back->classes[0].name, model.classes[0].name);
  EXPECT_EQ(back->balance, model.balance);
  EXPECT_EQ(back->level, model.level);
  cv::Mat before, after;
  const cv::Mat picture = hand_before(kWallColor);
  ColorTable::winners(model).apply(picture, &before);
  ColorTable::winners(*back).apply(picture, &after);
  EXPECT_EQ(cv::countNonZero(before != after), 0);
}

TEST(ColorModelYaml, WritingWhatWasReadChangesNothing) {
  const std::string once = written(general_model());
  const auto back = read(once);
  ASSERT_TRUE(back.ok());
  // Parts in a million add up to a million but for rounding, so that a few may move by one.
  const auto again = read(written(*back));
  ASSERT_TRUE(again.ok());
  EXPECT_LE(cv::norm(back->background.uv, again->background.uv, cv::NORM_INF), 1);
}

TEST(ColorModelYaml, SaysWhatIsWrongAndWhere) {
  const auto complaint = [](const std::string& text) {
    const auto model = read(text);
    EXPECT_FALSE(model.ok()) << text;
    return model.ok() ? std::string() : model.error().message();
  };
  EXPECT_THAT(complaint(with_rows("[]")), HasSubstr("class 'skin' has no pixels"));
  EXPECT_THAT(complaint(with_rows("[[3, 4, 0]]")), HasSubstr("class 'skin' has no pixels"));
  EXPECT_THAT(complaint(with_rows("[[3, 127, 1, 1]]")), HasSubstr("longer than the 128 cells"));
  EXPECT_THAT(complaint(with_rows("[[128, 1, 1]]")), HasSubstr("v and u"));
  EXPECT_THAT(complaint(with_rows("[[3, 4, -1]]")), HasSubstr("not a number"));
  EXPECT_THAT(complaint(with_rows("[[3, 4, .nan]]")), HasSubstr("not a number"));
  EXPECT_THAT(complaint(replaced(with_rows("[[3, 4, 1]]"), "name: skin", "nome: skin")),
              HasSubstr("unknown key 'nome'"));
  EXPECT_THAT(complaint(replaced(with_rows("[[3, 4, 1]]"), "128", "64")), HasSubstr("cells"));
  EXPECT_THAT(complaint("cells: 128\n"), HasSubstr("no background"));
  EXPECT_THAT(complaint(""), HasSubstr("model.yaml"));
  EXPECT_THAT(complaint("["), HasSubstr("not readable as YAML"));
  EXPECT_TRUE(read(with_rows("[[3, 4, 1]]")).ok());
}

TEST(ColorModelYaml, ATruncatedFileIsNeverReadAsSkin) {
  const std::string whole = written(general_model());
  const auto classes = whole.find("classes:");
  for (std::size_t length = 0; length < classes + 10; length += 37) {
    EXPECT_FALSE(read(whole.substr(0, length)).ok()) << "cut at " << length;
  }
}

}  // namespace
}  // namespace armsreach::gesture::test
