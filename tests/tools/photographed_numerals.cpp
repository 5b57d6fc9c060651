#include "photographed_numerals.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace armsreach::tools {

namespace fs = std::filesystem;

std::vector<BankExample> photographed_numerals(const std::string& folder,
                                               gesture::SkinSegmenter& skin) {
  std::vector<BankExample> examples;
  for (int numeral = 0; numeral < 10; ++numeral) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / std::to_string(numeral)))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      const int person = std::atoi(file.filename().c_str());
      if (person % kPeopleToOneKept == 0) continue;
      cv::Mat larger;
      cv::resize(cv::imread(file.string()), larger, {}, 2, 2, cv::INTER_LINEAR);
      examples.push_back({std::to_string(numeral), skin.segment(larger).clone(), false});
    }
  }
  return examples;
}

}  // namespace armsreach::tools
