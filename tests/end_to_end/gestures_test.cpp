// Gestures from the command line: learnt from one picture, found in another.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/program.hpp"

namespace armsreach::test {
namespace {

using ::testing::HasSubstr;

// A crude hand of skin's colour on blue: a palm and so many fingers.
cv::Mat drawn_hand(int fingers, double degrees) {
  cv::Mat image(240, 320, CV_8UC3, cv::Scalar(160, 90, 40));
  const cv::Scalar skin(125, 150, 205);
  cv::circle(image, {160, 140}, 34, skin, cv::FILLED);
  for (int i = 0; i < fingers; ++i) {
    const int x = 160 + 15 * (2 * i - fingers + 1) / 2;
    cv::line(image, {x, 130}, {160 + 2 * (x - 160), 55}, skin, 10);
  }
  cv::Mat turned;
  cv::warpAffine(image, turned, cv::getRotationMatrix2D({160, 140}, -degrees, 1), image.size(),
                 cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return turned;
}

TEST(EndToEndGestures, OneExampleIsEnough) {
  TemporaryFolder folder;
  const std::string templates = (folder / "templates").string();
  for (const int fingers : {1, 2, 4}) {
    const std::string picture = (folder / (std::to_string(fingers) + ".png")).string();
    cv::imwrite(picture, drawn_hand(fingers, 0));
    const auto learnt = run_armsreach({"learn", "gesture", "f" + std::to_string(fingers), picture,
                                       "--templates", templates, "--vocabulary", "drawn"});
    ASSERT_EQ(learnt.exit_code, 0) << learnt.output;
  }
  const std::string query = (folder / "query.png").string();
  cv::imwrite(query, drawn_hand(2, 30));
  const std::string json = (folder / "found.json").string();
  const auto found = run_armsreach({"detect", "gestures", query, "--templates", templates,
                                    "--vocabulary", "drawn", "--json", json});
  ASSERT_EQ(found.exit_code, 0) << found.output;
  const auto hands = nlohmann::json::parse(read_text(json));
  ASSERT_EQ(hands.size(), 1U);
  EXPECT_EQ(hands[0]["gesture"], "f2");
  EXPECT_NEAR(hands[0]["angle"].get<double>(), 0.5236, 0.02);  // a degree; the picture is blurred
  EXPECT_EQ(hands[0]["scores"].size(), 3U);
  EXPECT_EQ(hands[0]["scores"]["f2"], hands[0]["score"]);
}

TEST(EndToEndGestures, WhatIsWrongIsSaid) {
  TemporaryFolder folder;
  const std::string json = (folder / "found.json").string();
  const std::string blue = (folder / "blue.png").string();
  cv::imwrite(blue, cv::Mat(240, 320, CV_8UC3, cv::Scalar(160, 90, 40)));
  const auto no_hand =
      run_armsreach({"learn", "gesture", "L", blue, "--templates", (folder / "t").string()});
  EXPECT_EQ(no_hand.exit_code, 2);
  EXPECT_THAT(no_hand.output, HasSubstr("no hand is found"));
  const auto no_templates = run_armsreach(
      {"detect", "gestures", blue, "--templates", (folder / "none").string(), "--json", json});
  EXPECT_EQ(no_templates.exit_code, 2);
  EXPECT_THAT(no_templates.output, HasSubstr("learn gesture"));
  const auto no_vocabulary =
      run_armsreach({"detect", "gestures", blue, "--vocabulary", "morse", "--json", json});
  EXPECT_EQ(no_vocabulary.exit_code, 2);
  EXPECT_THAT(no_vocabulary.output, HasSubstr("asl-digits"));
}

}  // namespace
}  // namespace armsreach::test
