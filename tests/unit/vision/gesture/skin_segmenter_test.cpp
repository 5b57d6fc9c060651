#include "vision/gesture/skin_segmenter.hpp"

#include <gtest/gtest.h>

#include "painted_skin.hpp"

namespace armsreach::gesture::test {
namespace {

using Adaptation = SkinOptions::Adaptation;

TEST(SkinSegmenter, FindsTheHandAtAnySize) {
  SkinSegmenter segmenter(general_model());
  for (const cv::Size size : {cv::Size(160, 120), cv::Size(320, 240), cv::Size(641, 479),
                              cv::Size(1920, 1080), cv::Size(7, 5)}) {
    const cv::Mat& mask = segmenter.segment(hand_before(kWallColor, size));
    ASSERT_EQ(mask.size(), size);
    ASSERT_EQ(mask.type(), CV_8UC1);
    if (size.width > 100) {
      EXPECT_GT(f1(mask, fist(size)), 0.95) << size;
    }
  }
}

TEST(SkinSegmenter, LearnsTheDifferenceFromAWallOfSkinsColour) {
  const cv::Mat picture = hand_before(kBeigeColor);
  const cv::Mat truth = fist(picture.size());
  SkinSegmenter plain(general_model());
  SkinSegmenter adapting(general_model(), {.adaptation = Adaptation::image});
  EXPECT_LT(f1(plain.segment(picture), truth), 0.5);  // the wall is skin to the general model
  EXPECT_GT(f1(adapting.segment(picture), truth), 0.9);
  EXPECT_TRUE(adapting.adapted());
}

TEST(SkinSegmenter, LearnsNothingWhereThereIsNoHand) {
  for (const cv::Scalar& wall : {kSkinColor, kBeigeColor, kWallColor}) {
    SkinSegmenter segmenter(general_model(), {.adaptation = Adaptation::image});
    const cv::Mat picture = painted({320, 240}, wall);
    const cv::Mat mask = segmenter.segment(picture);
    EXPECT_FALSE(segmenter.adapted()) << wall;
    SkinSegmenter plain(general_model());
    EXPECT_EQ(cv::countNonZero(mask != plain.segment(picture)), 0) << wall;
  }
}

TEST(SkinSegmenter, AStreamKeepsWhatItLearntForAWhile) {
  SkinOptions options;
  options.adaptation = Adaptation::stream;
  options.interval = 3;
  options.patience = 2;
  SkinSegmenter segmenter(general_model(), options);
  segmenter.segment(hand_before(kBeigeColor));
  ASSERT_TRUE(segmenter.adapted());
  const cv::Mat empty = painted({320, 240}, kBeigeColor);
  for (int i = 0; i < 5; ++i) segmenter.segment(empty);  // asked once more, and refused
  EXPECT_TRUE(segmenter.adapted());
  segmenter.segment(empty);  // the second refusal
  EXPECT_FALSE(segmenter.adapted());
}

TEST(SkinReestimation, RefusesByEachPieceOfEvidence) {
  const SkinEvidence hand{
      .area = 0.1, .border = 0.05, .compact = 0.8, .agreement = 0.9, .overlap = 0.05};
  EXPECT_FALSE(refusal(hand));
  for (const auto& [member, bad] : {std::pair{&SkinEvidence::area, 0.001},
                                    {&SkinEvidence::area, 0.7},
                                    {&SkinEvidence::border, 0.5},
                                    {&SkinEvidence::compact, 0.2},
                                    {&SkinEvidence::agreement, 0.3},
                                    {&SkinEvidence::overlap, 0.6}}) {
    SkinEvidence evidence = hand;
    evidence.*member = bad;
    EXPECT_TRUE(refusal(evidence)) << bad;
  }
}

}  // namespace
}  // namespace armsreach::gesture::test
