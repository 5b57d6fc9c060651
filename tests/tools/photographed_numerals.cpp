#include "photographed_numerals.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace armsreach::tools {
namespace {

namespace fs = std::filesystem;

// Skin is redder than the background; where to cut is Otsu's to say.
cv::Mat hand_mask(const cv::Mat& bgr) {
  std::vector<cv::Mat> channels;
  cv::split(bgr, channels);
  cv::Mat redness;
  cv::subtract(channels[2], channels[0], redness);
  cv::GaussianBlur(redness, redness, {3, 3}, 0);
  cv::normalize(redness, redness, 0, 255, cv::NORM_MINMAX);
  cv::Mat mask;
  cv::threshold(redness, mask, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  return mask;
}

}  // namespace

std::vector<BankExample> photographed_numerals(const std::string& folder) {
  std::vector<BankExample> examples;
  for (int numeral = 0; numeral < 10; ++numeral) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / std::to_string(numeral)))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      const int person = std::atoi(file.filename().c_str());
      if (person % 2 == 0)
        examples.push_back({std::to_string(numeral), hand_mask(cv::imread(file.string())), false});
    }
  }
  return examples;
}

}  // namespace armsreach::tools
