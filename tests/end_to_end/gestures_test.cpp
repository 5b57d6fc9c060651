// Gestures from the command line: learnt from one picture, found in another.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

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

// g by its definition: the best, over turns of the hand and its mirror image, of the weighted mean
// of products of samples in {+1, -1} on rings around the mask's centroid.
double g_from(const cv::Mat& mask, const std::string& templates) {
  std::istringstream lines(templates);
  const auto values = [&](const std::string& key) {
    std::string line, first;
    std::getline(lines, line);
    std::istringstream words(line);
    words >> first;
    EXPECT_EQ(first, key);
    return std::vector<double>(std::istream_iterator<double>(words), {});
  };
  std::string line;
  std::getline(lines, line);  // the format
  const int samples = static_cast<int>(values("samples").at(0));
  const auto radii = values("radii"), weights = values("weights");
  std::string kind;
  lines >> kind >> std::hex;
  std::vector<unsigned> known(samples);
  for (unsigned& bits : known) lines >> bits;
  const cv::Moments moments = cv::moments(mask, true);
  const auto sample = [&](std::size_t ring, int angle, bool mirrored) {
    const double theta = 2 * std::numbers::pi * angle / samples;
    const double radius = radii[ring] * std::sqrt(moments.m00);
    const double along = mirrored ? -std::cos(theta) : std::cos(theta);
    const cv::Point at(
        static_cast<int>(std::lround(moments.m10 / moments.m00 + radius * along)),
        static_cast<int>(std::lround(moments.m01 / moments.m00 + radius * std::sin(theta))));
    return cv::Rect({0, 0}, mask.size()).contains(at) && mask.at<std::uint8_t>(at) != 0 ? 1 : -1;
  };
  double best = -1;
  for (const bool mirrored : {false, true}) {
    for (int shift = 0; shift < samples; ++shift) {
      double sum = 0, total = 0;
      for (std::size_t ring = 0; ring < radii.size(); ++ring) {
        for (int angle = 0; angle < samples; ++angle) {
          const int template_sample = (known[angle] >> ring) & 1U ? 1 : -1;
          sum += weights[ring] * template_sample * sample(ring, angle + shift, mirrored);
          total += weights[ring];
        }
      }
      best = std::max(best, sum / total);
    }
  }
  return best;
}

// The picture and its mask, in two folders.
void save_hand(const TemporaryFolder& folder, const std::string& name, const cv::Mat& picture) {
  std::filesystem::create_directories(folder / "masks");
  cv::imwrite(folder / (name + ".png"), picture);
  cv::Mat red;
  cv::extractChannel(picture, red, 2);
  cv::imwrite(folder / "masks" / (name + ".png"), red > 120);
}

TEST(EndToEndGestures, ScoresAreTheDefinitionRecomputedFromTheMaskForBothRings) {
  TemporaryFolder folder;
  save_hand(folder, "two", drawn_hand(2, 0));
  save_hand(folder, "four", drawn_hand(4, 0));
  save_hand(folder, "query", drawn_hand(2, 75));
  const std::string masks = folder / "masks";
  for (const std::string rings : {"paper", "linear"}) {
    const std::string templates = folder / rings;
    for (const std::string name : {"two", "four"}) {
      const auto learnt =
          run_armsreach({"learn", "gesture", name, folder / (name + ".png"), "--masks", masks,
                         "--templates", templates, "--rings", rings});
      ASSERT_EQ(learnt.exit_code, 0) << learnt.output;
    }
    const std::string json = folder / "found.json";
    const auto found = run_armsreach({"detect", "gestures", folder / "query.png", "--masks", masks,
                                      "--templates", templates, "--json", json});
    ASSERT_EQ(found.exit_code, 0) << found.output;
    const auto hands = nlohmann::json::parse(read_text(json));
    ASSERT_EQ(hands.size(), 1U);
    const cv::Mat mask = cv::imread(folder / "masks" / "query.png", cv::IMREAD_GRAYSCALE);
    EXPECT_EQ(hands[0]["area"], cv::countNonZero(mask));
    for (const std::string name : {"two", "four"}) {
      const std::string text = read_text(folder / rings / "wearable" / (name + ".txt"));
      EXPECT_THAT(text, HasSubstr(rings == "paper" ? "samples 180\n" : "samples 90\n"));
      // The program counts whole samples, so the two differ by rounding alone.
      EXPECT_NEAR(hands[0]["scores"][name].get<double>(), g_from(mask, text), 1e-9) << rings;
    }
  }
}

TEST(EndToEndGestures, AFolderOfTemplatesKeepsOneLayout) {
  TemporaryFolder folder;
  const std::string templates = folder / "templates", hand = folder / "hand.png";
  cv::imwrite(hand, drawn_hand(2, 0));
  const auto learn = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{"learn", "gesture", "--templates", templates};
    command.insert(command.end(), more.begin(), more.end());
    return run_armsreach(command);
  };
  ASSERT_EQ(learn({"L", hand, "--rings", "paper"}).exit_code, 0);
  const auto refused = learn({"M", hand, "--rings", "linear"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("5 rings of 180 samples, radii 0.08125 0.1625"));
  EXPECT_THAT(refused.output, HasSubstr("16 rings of 90 samples, radii 0.3"));
  EXPECT_EQ(learn({"M", hand}).exit_code, 0);  // takes the folder's
  const auto found = run_armsreach(
      {"detect", "gestures", hand, "--templates", templates, "--json", folder / "found.json"});
  EXPECT_EQ(found.exit_code, 0) << found.output;
}

TEST(EndToEndGestures, WhatCannotBeReadIsLeftOut) {
  TemporaryFolder folder;
  const std::string json = folder / "found.json";
  std::filesystem::create_directories(folder / "all");
  write_text(folder / "all/1.png", "no picture");
  write_text(folder / "all/2.MP4", "no video");
  cv::imwrite(folder / "all/3.png", drawn_hand(2, 0));
  const auto some = run_armsreach(
      {"detect", "gestures", folder / "all", folder / "mistyped.png", "--json", json});
  EXPECT_EQ(some.exit_code, 0) << some.output;
  EXPECT_THAT(some.output, HasSubstr("1.png: not a readable image (give whole pictures"));
  EXPECT_THAT(some.output, HasSubstr("2.MP4"));
  EXPECT_THAT(some.output, HasSubstr("mistyped.png: is not there"));
  EXPECT_THAT(some.output, HasSubstr("3 could not be read"));
  EXPECT_EQ(nlohmann::json::parse(read_text(json)).size(), 1U);
  std::filesystem::remove(json);
  const auto none = run_armsreach({"detect", "gestures", folder / "all/1.png", "--json", json});
  EXPECT_EQ(none.exit_code, 2) << none.output;
  EXPECT_FALSE(std::filesystem::exists(json));
}

TEST(EndToEndGestures, VideosOfAFolderAreSeenWhateverTheCaseOfTheirNames) {
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "videos");
  const std::string video = folder / "videos/HAND.AVI";
  {
    cv::VideoWriter writer(video, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, {320, 240});
    ASSERT_TRUE(writer.isOpened());
    for (int i = 0; i < 3; ++i) writer.write(drawn_hand(2, 0));
  }
  const std::string json = folder / "found.json";
  const auto found = run_armsreach({"detect", "gestures", folder / "videos", "--json", json});
  ASSERT_EQ(found.exit_code, 0) << found.output;
  const auto hands = nlohmann::json::parse(read_text(json));
  ASSERT_EQ(hands.size(), 3U);
  EXPECT_EQ(hands[2]["frame"], 2);
}

TEST(EndToEndGestures, AMissedHandCountsAndAnUnknownClassIsRefused) {
  TemporaryFolder folder;
  const std::string templates = folder / "templates", json = folder / "figures.json";
  for (const std::string name : {"f1", "f4"}) {
    std::filesystem::create_directories(folder / "test" / name);
    const std::string picture = folder / "test" / name / "hand.png";
    cv::imwrite(picture, drawn_hand(name == "f1" ? 1 : 4, 0));
    ASSERT_EQ(
        run_armsreach({"learn", "gesture", name, picture, "--templates", templates}).exit_code, 0);
  }
  const auto area = [&] {
    const auto result = run_armsreach(
        {"evaluate", "gestures", folder / "test", "--templates", templates, "--json", json});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return nlohmann::json::parse(read_text(json))["curves"][0]["area"].get<double>();
  };
  EXPECT_DOUBLE_EQ(area(), 1);
  cv::imwrite(folder / "test/f1/none.png", cv::Mat(240, 320, CV_8UC3, cv::Scalar(160, 90, 40)));
  // One of three is below two of the three that are not there, and level with the third.
  EXPECT_DOUBLE_EQ(area(), (1 + 1 + 0.5 / 3) / 3);
  std::filesystem::create_directories(folder / "test/wave");
  const auto unknown =
      run_armsreach({"evaluate", "gestures", folder / "test", "--templates", templates});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.output, HasSubstr("'wave' is no gesture of the templates (they know f1 f4"));
}

// Hands with dark creases below their fingers, and the same outlines smooth.
TEST(EndToEndGestures, WhatHandsLookLikeWithinIsLearntAndCounts) {
  TemporaryFolder folder;
  for (const std::string name : {"creased", "smooth"}) {
    std::filesystem::create_directories(folder / name);
    for (int i = 0; i < 24; ++i) {
      cv::Mat hand = drawn_hand(2 + i % 3, 2.0 * i - 24);
      for (const int x : {140, 152, 168, 180}) {
        if (name == "smooth") break;
        cv::line(hand, {x, 125}, {x, 155}, cv::Scalar(60, 75, 105), 4, cv::LINE_AA);
      }
      cv::imwrite(folder / name / (std::to_string(i) + ".png"), hand);
    }
  }
  const std::string model = folder / "hands.txt", json = folder / "found.json";
  const auto learnt = run_armsreach({"learn", "hands", folder / "creased", "--without",
                                     folder / "smooth", folder / "nowhere", "--out", model});
  EXPECT_EQ(learnt.exit_code, 0) << learnt.output;
  EXPECT_THAT(learnt.output, HasSubstr("left out"));
  EXPECT_THAT(learnt.output, HasSubstr("learnt from 24 hands"));
  EXPECT_THAT(learnt.output, HasSubstr("tells 100 %"));

  const std::string picture = folder / "creased/12.png", templates = folder / "templates";
  ASSERT_EQ(run_armsreach({"learn", "gesture", "f", picture, "--templates", templates}).exit_code,
            0);
  const auto gesture_with = [&](const std::string& hands) {
    const auto found = run_armsreach({"detect", "gestures", picture, "--templates", templates,
                                      "--hands", hands, "--json", json});
    EXPECT_EQ(found.exit_code, 0) << found.output;
    return nlohmann::json::parse(read_text(json)).at(0)["gesture"];
  };
  EXPECT_EQ(gesture_with(model), "f");
  // A model that takes nothing for a hand: the same weights, another constant.
  std::istringstream lines(read_text(model));
  std::string format, constant, weights;
  std::getline(lines, format);
  std::getline(lines, constant);
  std::getline(lines, weights, '\0');
  std::ofstream(folder / "never.txt") << format << "\n-100\n" << weights;
  EXPECT_TRUE(gesture_with(folder / "never.txt").is_null());

  const auto few = run_armsreach({"learn", "hands", folder / "creased", "--without",
                                  folder / "smooth/1.png", "--out", folder / "few.txt"});
  EXPECT_EQ(few.exit_code, 2);
  EXPECT_THAT(few.output, HasSubstr("24 hands"));
  const auto missing = run_armsreach(
      {"detect", "gestures", picture, "--hands", folder / "none.txt", "--json", json});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.output, HasSubstr("learn hands"));
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
