// The program's own templates on photographs of people who are not in them.
#include <filesystem>
#include <fstream>
#include <iostream>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/recordings.hpp"
#include "vision/gesture/color_model_yaml.hpp"
#include "vision/gesture/gesture_detector.hpp"
#include "vision/gesture/skin_segmenter.hpp"

namespace armsreach::gesture {
namespace {

namespace fs = std::filesystem;

GestureDetector own_detector(const std::string& vocabulary) {
  TemplateSet set;
  const fs::path folder = fs::path(ARMSREACH_SOURCE_DIR) / "assets/gestures" / vocabulary;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path());
    EXPECT_TRUE(read_templates(in, entry.path().stem().string(), entry.path().string(), &set));
  }
  const GestureDetectorOptions options = options_for(set);
  return GestureDetector(std::move(set), options);
}

struct Rates {
  int all = 0, right = 0, wrong = 0;
  double share(int count) const { return static_cast<double>(count) / all; }
};

void add(const GestureDetector& detector, const cv::Mat& mask, const std::string& truth,
         Rates* rates) {
  ++rates->all;
  for (const HandObservation& hand : detector.detect(mask)) {
    if (hand.gesture) ++(*hand.gesture == truth ? rates->right : rates->wrong);
  }
}

TEST(GesturePhotos, NumeralsOfUnseenPeople) {
  ARMSREACH_RECORDING_OR_SKIP(cutout, "hands/cutout");
  const GestureDetector detector = own_detector("asl-digits");
  Rates rates;
  for (int numeral = 0; numeral < 10; ++numeral) {
    for (const auto& entry : fs::directory_iterator(cutout / std::to_string(numeral))) {
      std::vector<cv::Mat> channels;
      cv::split(cv::imread(entry.path().string()), channels);
      const cv::Mat brightest = cv::max(cv::max(channels[0], channels[1]), channels[2]);
      add(detector, brightest >= 12, std::to_string(numeral), &rates);
    }
  }
  std::cout << "right " << rates.share(rates.right) << ", wrong " << rates.share(rates.wrong)
            << " of " << rates.all << '\n';
  EXPECT_GE(rates.share(rates.right), 0.93);
  EXPECT_LE(rates.share(rates.wrong), 0.02);
}

// People whose number divides by five are in no template. Skin and all, as the program does it.
// Measured: right 0.970, wrong 0.008; over five such parts of the people, each with templates of
// the others, about 0.957 and 0.027 (before least_score rose to 0.92).
TEST(GesturePhotos, PhotographedNumeralsOfUnseenPeople) {
  ARMSREACH_RECORDING_OR_SKIP(digits, "hands/digits");
  const std::string path = ARMSREACH_SOURCE_DIR "/assets/skin/default.yaml";
  std::ifstream in(path);
  SkinSegmenter skin(*read_color_model(in, path), {.adaptation = SkinOptions::Adaptation::image});
  const GestureDetector detector = own_detector("asl-digits");
  Rates rates;
  for (int numeral = 0; numeral < 10; ++numeral) {
    for (const auto& entry : fs::directory_iterator(digits / std::to_string(numeral))) {
      if (std::stoi(entry.path().filename().string()) % 5 != 0) continue;
      cv::Mat larger;
      cv::resize(cv::imread(entry.path().string()), larger, {}, 2, 2, cv::INTER_LINEAR);
      add(detector, skin.segment(larger), std::to_string(numeral), &rates);
    }
  }
  std::cout << "right " << rates.share(rates.right) << ", wrong " << rates.share(rates.wrong)
            << " of " << rates.all << '\n';
  EXPECT_GE(rates.share(rates.right), 0.95);
  EXPECT_LE(rates.share(rates.wrong), 0.025);
}

}  // namespace
}  // namespace armsreach::gesture
