// Do simulated hands look like hands? Both ways, by their outlines alone: photographs of ten
// numerals are named by simulated ones, and simulated ones by the photographs.
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "devices/sim/hand/gesture.hpp"
#include "devices/sim/hand/silhouette.hpp"
#include "silhouette_matcher.hpp"
#include "tests/support/recordings.hpp"

namespace armsreach::sim {
namespace {

struct Named {
  int numeral;
  cv::Mat mask;
};

Gesture numeral(int n) { return static_cast<Gesture>(static_cast<int>(Gesture::zero) + n); }

// Hands of different people, who cut their wrists off differently, each with manners of its own.
std::vector<Named> simulated(std::uint64_t first_seed, int people) {
  std::vector<Named> all;
  SilhouetteCamera camera(160);
  for (int person = 0; person < people; ++person) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(person);
    HandSurfaceOptions options;
    options.forearm = 0.005 + 0.015 * (person % 3);
    options.cell = 0.004;
    const HandSurface surface(random_anatomy(seed), options);
    for (int n = 0; n < 10; ++n) {
      const HandPose pose =
          pose_of(numeral(n), surface.anatomy(), 100 * seed + static_cast<std::uint64_t>(n));
      HandView view;
      view.turn = shown_turn(numeral(n)) + 0.12 * (person % 5 - 2);
      all.push_back({n, camera.draw(surface, pose, view)});
    }
  }
  return all;
}

std::vector<Named> photographed(const std::filesystem::path& folder) {
  std::vector<Named> all;
  for (int n = 0; n < 10; ++n) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder / std::to_string(n)))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
      cv::Mat channels[3];
      cv::split(cv::imread(file.string()), channels);
      const cv::Mat brightest = cv::max(cv::max(channels[0], channels[1]), channels[2]);
      all.push_back({n, brightest >= 12});
    }
  }
  return all;
}

// Prints how often each numeral got which name; returns the share of right ones.
double right_share(const std::vector<Named>& bank, const std::vector<Named>& asked) {
  SilhouetteMatcher matcher;
  for (const Named& one : bank) matcher.add(one.numeral, one.mask);
  std::array<std::array<int, 10>, 10> named{};
  int right = 0;
  for (const Named& one : asked) {
    const int name = matcher.name(one.mask);
    ++named[static_cast<std::size_t>(one.numeral)][static_cast<std::size_t>(name)];
    right += name == one.numeral;
  }
  for (std::size_t n = 0; n < named.size(); ++n) {
    std::cout << n << " named as 0..9:";
    for (const int count : named[n]) std::cout << ' ' << count;
    std::cout << '\n';
  }
  const double share = static_cast<double>(right) / static_cast<double>(asked.size());
  std::cout << "right: " << share << '\n';
  return share;
}

TEST(HandRealism, SimulatedNumeralsNamePhotographs) {
  ARMSREACH_RECORDING_OR_SKIP(cutout, "hands/cutout");
  EXPECT_GE(right_share(simulated(1, 15), photographed(cutout)), 0.8);
}

TEST(HandRealism, PhotographsNameSimulatedNumerals) {
  ARMSREACH_RECORDING_OR_SKIP(cutout, "hands/cutout");
  EXPECT_GE(right_share(photographed(cutout), simulated(1001, 15)), 0.8);
}

}  // namespace
}  // namespace armsreach::sim
