// Skin is calibrated, colours are taught and found, all through the program.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/program.hpp"
#include "tests/support/recordings.hpp"

namespace armsreach::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// A table with a thing on it.
cv::Mat picture(const cv::Scalar& color, const cv::Point& at) {
  cv::Mat bgr(200, 320, CV_8UC3);
  cv::RNG random(3);
  random.fill(bgr, cv::RNG::UNIFORM, 35, 55);
  cv::circle(bgr, at, 16, color, -1);
  return bgr;
}

nlohmann::json read_json(const fs::path& file) { return nlohmann::json::parse(read_text(file)); }

TEST(EndToEndColors, TaughtByPointingAndFoundAgain) {
  TemporaryFolder folder;
  const cv::Scalar red(30, 30, 220), blue(220, 100, 30);
  fs::create_directories(folder / "red");
  cv::imwrite(folder / "red/1.png", picture(red, {100, 100}));
  cv::imwrite(folder / "red/2.png", picture(red, {180, 90}));
  cv::imwrite(folder / "blue.png", picture(blue, {220, 60}));
  cv::imwrite(folder / "new.png", picture(blue, {90, 140}));
  const std::string classes = folder / "classes.yaml";
  const auto first =
      run_armsreach({"learn", "colour", "red ball", folder / "red", "--classes", classes});
  ASSERT_EQ(first.exit_code, 0) << first.output;
  const auto second = run_armsreach({"learn", "colour", "blue ball", folder / "blue.png",
                                     "--region", "190,30,60,60", "--classes", classes});
  ASSERT_EQ(second.exit_code, 0) << second.output;
  EXPECT_THAT(second.output, HasSubstr("2 classes"));
  const auto found = run_armsreach({"detect", "colours", folder / "new.png", folder / "red",
                                    "--classes", classes, "--json", folder / "found.json"});
  ASSERT_EQ(found.exit_code, 0) << found.output;
  const auto json = read_json(folder / "found.json");
  ASSERT_EQ(json.size(), 3U);
  ASSERT_EQ(json[0]["blobs"].size(), 1U);
  EXPECT_EQ(json[0]["blobs"][0]["name"], "blue ball");
  EXPECT_NEAR(json[0]["blobs"][0]["box"][0].get<int>(), 90 - 16, 1);
  EXPECT_NEAR(json[0]["blobs"][0]["box"][3].get<int>(), 33, 2);
  EXPECT_EQ(json[1]["blobs"][0]["name"], "red ball");
}

TEST(EndToEndColors, ToysAreNamedInOtherShots) {
  ARMSREACH_RECORDING_OR_SKIP(toys, "objects/toys");
  TemporaryFolder folder;
  const std::string classes = folder / "classes.yaml";
  const std::vector<std::string> names{"bball", "orange", "pear", "plego", "wball"};
  std::vector<std::string> others;
  std::vector<std::string> expected;
  for (const std::string& name : names) {
    std::vector<std::string> shots;
    for (const auto& entry : fs::directory_iterator(toys / name)) {
      const std::string file = entry.path();
      if (file.find("_FG") == std::string::npos) shots.push_back(file);
    }
    std::sort(shots.begin(), shots.end());
    ASSERT_EQ(shots.size(), 16U);
    std::vector<std::string> command{"learn", "colour", name, "--classes", classes};
    command.insert(command.begin() + 3, shots.begin(), shots.begin() + 8);
    const auto learnt = run_armsreach(command);
    ASSERT_EQ(learnt.exit_code, 0) << learnt.output;
    others.insert(others.end(), shots.begin() + 8, shots.end());
    expected.insert(expected.end(), 8, name);
  }
  std::vector<std::string> command{"detect", "colours", "--classes",
                                   classes,  "--json",  folder / "found.json"};
  command.insert(command.begin() + 2, others.begin(), others.end());
  const auto found = run_armsreach(command);
  ASSERT_EQ(found.exit_code, 0) << found.output;
  const auto json = read_json(folder / "found.json");
  int right = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& blobs = json[i]["blobs"];
    right += !blobs.empty() && blobs[0]["name"] == expected[i];  // the largest
  }
  EXPECT_GE(right, 38) << "of 40";  // 95 %
}

TEST(EndToEndColors, SkinIsCalibratedWithAndWithoutMasks) {
  TemporaryFolder folder;
  cv::Mat bgr(240, 320, CV_8UC3), mask = cv::Mat::zeros(240, 320, CV_8UC1);
  cv::RNG random(5);
  random.fill(bgr, cv::RNG::UNIFORM, 60, 80);
  cv::ellipse(mask, {160, 130}, {40, 55}, 0, 0, 360, cv::Scalar(255), -1);
  bgr.setTo(cv::Scalar(120, 150, 205), mask);
  fs::create_directories(folder / "masks");
  cv::imwrite(folder / "me.png", bgr);
  cv::imwrite(folder / "masks/me.png", mask);
  for (const bool with_masks : {true, false}) {
    std::vector<std::string> command{"calibrate", "skin", folder / "me.png", "--out",
                                     folder / "skin.yaml"};
    if (with_masks) command.insert(command.end(), {"--masks", folder / "masks"});
    const auto result = run_armsreach(command);
    ASSERT_EQ(result.exit_code, 0) << result.output;
    // Two plain colours: nothing can be confused.
    EXPECT_THAT(result.output, HasSubstr("from 1 view, F1 1.000"));
  }
}

TEST(EndToEndColors, ALiveViewTeachesSkinOnlyWhereThereIsAHand) {
  ARMSREACH_RECORDING_OR_SKIP(hand, "hands/video/count.mp4");
  ARMSREACH_RECORDING_OR_SKIP(kitchen, "rgbd/redkitchen");
  TemporaryFolder folder;
  const auto calibrated = [&](const std::string& source) {
    return run_armsreach(
        {"calibrate", "skin", "--source", source, "--frames", "40", "--out", folder / "skin.yaml"});
  };
  const auto refused = calibrated("tum:" + kitchen.string());  // wooden cupboards
  EXPECT_EQ(refused.exit_code, 2) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("hardly ever a hand"));
  EXPECT_FALSE(fs::exists(folder / "skin.yaml"));
  const auto learnt = calibrated("video:" + hand.string());
  EXPECT_EQ(learnt.exit_code, 0) << learnt.output;
  EXPECT_THAT(learnt.output, HasSubstr("which is no truth"));
}

TEST(EndToEndColors, ModelsOfSkinAndOfThingsAreNotTakenForEachOther) {
  TemporaryFolder folder;
  const std::string thing = folder / "thing.png", things = folder / "things.yaml",
                    skin = folder / "skin.yaml", json = folder / "found.json";
  cv::imwrite(thing, picture({30, 30, 220}, {100, 100}));
  write_text(folder / "pixels.csv", [] {
    std::string lines;
    for (int i = 0; i < 60; ++i) lines += "120,150,205,1\n70,110,60,2\n";
    return lines;
  }());
  const auto taught = run_armsreach({"learn", "colour", "ball", thing, "--classes", things});
  ASSERT_EQ(taught.exit_code, 0) << taught.output;
  EXPECT_THAT(taught.output, HasSubstr("1 picture; 1 class in"));
  ASSERT_EQ(run_armsreach({"calibrate", "skin", "--pixels", folder / "pixels.csv", "--out", skin})
                .exit_code,
            0);
  const auto complaint = [&](const std::vector<std::string>& command) {
    const auto result = run_armsreach(command);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    return result.output;
  };
  EXPECT_THAT(complaint({"detect", "gestures", thing, "--skin", things, "--json", json}),
              HasSubstr("has no class 'skin'"));
  EXPECT_THAT(complaint({"detect", "colours", thing, "--classes", skin, "--json", json}),
              HasSubstr("model of skin, not of things"));
  EXPECT_THAT(complaint({"learn", "colour", "ball", thing, "--classes", skin}),
              HasSubstr("model of skin, not of things"));
  const auto run_with = [&](const std::string& gesture) {
    write_text(folder / "config.yaml", "gesture: {" + gesture + "}\n");
    return complaint({"run", "--source", "images:" + folder.path().string(), "--experience",
                      "wearable", "--display", "none", "--frames", "1", "--config",
                      folder / "config.yaml"});
  };
  EXPECT_THAT(run_with("skin: " + things), HasSubstr("has no class 'skin'"));
  EXPECT_THAT(run_with("colours: " + skin), HasSubstr("model of skin, not of things"));
  const std::string before = read_text(things);
  EXPECT_THAT(complaint({"learn", "colour", "", thing, "--classes", things}),
              HasSubstr("has no name"));
  EXPECT_THAT(complaint({"learn", "colour", "skin", thing, "--classes", things}),
              HasSubstr("name of skin itself"));
  EXPECT_EQ(read_text(things), before);
}

TEST(EndToEndColors, BadInputIsExplained) {
  TemporaryFolder folder;
  fs::create_directories(folder / "empty");
  fs::create_directories(folder / "masks");
  const std::string out = folder / "out.yaml";
  const auto complaint = [&](const std::vector<std::string>& command) {
    const auto result = run_armsreach(command);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    return result.output;
  };
  cv::imwrite(folder / "grey.png", cv::Mat(60, 80, CV_8UC1, cv::Scalar(90)));
  cv::imwrite(folder / "plain.png", cv::Mat(60, 80, CV_8UC3, cv::Scalar(90, 120, 60)));
  cv::imwrite(folder / "masks/plain.png", cv::Mat(50, 80, CV_8UC1, cv::Scalar(255)));
  write_text(folder / "classes.yaml", "cells: 128\nbackground: {luma: [1");
  EXPECT_THAT(complaint({"calibrate", "skin", folder / "grey.png", "--out", out}),
              HasSubstr("grey picture"));
  EXPECT_THAT(complaint({"calibrate", "skin", folder / "empty", "--out", out}),
              HasSubstr("no images in the folder"));
  EXPECT_THAT(complaint({"calibrate", "skin", folder / "plain.png", "--out", out}),
              HasSubstr("no view shows a hand"));
  EXPECT_THAT(complaint({"calibrate", "skin", folder / "plain.png", "--masks", folder / "masks",
                         "--out", out}),
              HasSubstr("is 80x50, its picture 80x60"));
  EXPECT_THAT(complaint({"learn", "colour", "x", folder / "plain.png", "--classes", out}),
              HasSubstr("nothing stands out"));
  EXPECT_THAT(complaint({"learn", "colour", "x", folder / "plain.png", "--region", "70,0,20,20",
                         "--classes", out}),
              HasSubstr("beyond the picture"));
  EXPECT_THAT(complaint({"detect", "colours", folder / "plain.png", "--classes",
                         folder / "classes.yaml", "--json", folder / "x.json"}),
              HasSubstr("not readable as YAML"));
  write_text(folder / "text.txt", "hello\n");
  EXPECT_THAT(complaint({"calibrate", "skin", "--pixels", folder / "text.txt", "--out", out}),
              HasSubstr("text.txt: has no lines of pixels"));
  EXPECT_THAT(complaint({"calibrate", "skin", folder / "mistyped.png", "--out", out}),
              HasSubstr("mistyped.png: is not there"));
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace armsreach::test
