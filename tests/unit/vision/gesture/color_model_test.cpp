#include "vision/gesture/color_model.hpp"

#include <gtest/gtest.h>

#include "painted_skin.hpp"
#include "vision/gesture/color_table.hpp"

namespace armsreach::gesture::test {
namespace {

cv::Vec3b bytes(const cv::Scalar& color) {
  return {cv::saturate_cast<std::uint8_t>(color[0]), cv::saturate_cast<std::uint8_t>(color[1]),
          cv::saturate_cast<std::uint8_t>(color[2])};
}

TEST(ColorSpace, GreysOfAnyBrightnessShareTheMiddleCell) {
  const ColorProjection projection;
  for (int level = 0; level < 256; ++level) {
    const ColorCell cell =
        projection({static_cast<std::uint8_t>(level), static_cast<std::uint8_t>(level),
                    static_cast<std::uint8_t>(level)});
    EXPECT_EQ(cell.u, kUvSide / 2) << level;
    EXPECT_EQ(cell.v, kUvSide / 2) << level;
    EXPECT_EQ(cell.luma, level * kLumas / 256) << level;
  }
}

TEST(ColorSpace, PureColoursReachTheEndsWithoutLeavingThePlane) {
  const ColorProjection projection({3, 3, 3});
  EXPECT_EQ(projection({255, 0, 0}).u, kUvSide - 1);
  EXPECT_EQ(projection({0, 0, 255}).v, kUvSide - 1);
  EXPECT_EQ(projection({0, 255, 0}).u, 0);
  EXPECT_EQ(projection({255, 255, 255}).luma, kLumas - 1);
}

TEST(ColorTable, TheLikelierClassWinsAndTheUnseenIsBackground) {
  const ColorTable table = ColorTable::winners(general_model());
  EXPECT_EQ(table.at(bytes(kSkinColor)), 1);
  EXPECT_EQ(table.at(bytes(kWallColor)), 0);
  EXPECT_EQ(table.at({255, 0, 255}), 0);  // magenta, which neither class has
}

TEST(ColorTable, PosteriorsFollowBayes) {
  ColorModel model;
  const ColorCell cell{60, 70, 8}, other{20, 20, 8};
  model.background.add(cell, 1);
  model.background.add(other, 3);
  model.classes.push_back({"thing", {}});
  model.classes[0].pixels.add(cell, 4);
  // p(c|thing) = 1, p(c|background) = 1/4, smoothed alike: 255 * 1 / (1 + 1/4) = 204; what is kept
  // for unseen colours moves that by less than one.
  const ColorTable table = ColorTable::posteriors(model, 0);
  const ColorProjection projection;
  for (int b = 0; b < 256; ++b) {
    for (int r = 0; r < 256; ++r) {
      const cv::Vec3b color(static_cast<std::uint8_t>(b), 128, static_cast<std::uint8_t>(r));
      const ColorCell at = projection(color);
      if (at.u == cell.u && at.v == cell.v) {
        EXPECT_NEAR(table.at(color), 204, 1);
      }
    }
  }
}

TEST(ColorTable, BrightnessTellsWhiteFromBlackOnlyWhereAsked) {
  ColorModel model;
  const ColorProjection projection;
  model.background.add(projection({20, 20, 20}), 100);
  model.classes.push_back({"white ball", {}});
  model.classes[0].pixels.add(projection({230, 230, 230}), 100);
  model.with_luma = true;
  const ColorTable table = ColorTable::winners(model);
  EXPECT_EQ(table.at({230, 230, 230}), 1);
  EXPECT_EQ(table.at({20, 20, 20}), 0);
}

TEST(ColorTable, BalanceUndoesATint) {
  ColorModel model = general_model();
  const cv::Mat picture = hand_before(kWallColor);
  cv::Mat plain, tinted, balanced;
  ColorTable::winners(model).apply(picture, &plain);
  std::vector<cv::Mat> channels;
  cv::split(picture, channels);
  channels[0] *= 0.5;  // a warm lamp
  cv::merge(channels, tinted);
  model.balance = {2, 1, 1};
  ColorTable::winners(model).apply(tinted, &balanced);
  // Halving rounds blue to a level of 2: only pixels at the edge of a cell of 2 levels may change.
  EXPECT_LT(cv::countNonZero(plain != balanced), 0.01 * static_cast<double>(plain.total()));
}

}  // namespace
}  // namespace armsreach::gesture::test
