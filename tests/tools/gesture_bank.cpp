// Makes the templates in assets/gestures:
//   armsreach_gesture_bank OUT_FOLDER SIGN_LANGUAGE_DIGITS_FOLDER SKIN_MODEL
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "photographed_numerals.hpp"
#include "simulated_gestures.hpp"
#include "vision/gesture/color_model_yaml.hpp"
#include "vision/gesture/gesture_detector.hpp"

namespace armsreach::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kWearablePeople = 30;
constexpr int kNumeralPeople = 16;

gesture::TemplateSet bank_of(const std::vector<BankExample>& examples,
                             const gesture::RingLayout& layout) {
  gesture::TemplateSet set{layout, {}};
  const gesture::HandFinder finder;
  for (const BankExample& one : examples) {
    const auto blobs = finder.find(one.mask);
    if (blobs.empty()) continue;
    auto made = gesture::template_of(one.gesture, blobs[0].readings[0], set.layout);
    made.upright = made.upright || one.upright;
    set.templates.push_back(made);
  }
  return set;
}

bool write(const fs::path& folder, const gesture::TemplateSet& set) {
  fs::create_directories(folder);
  const gesture::RingMatcher matcher(set);
  for (const std::string& name : matcher.gestures()) {
    std::ofstream out(folder / (name + ".txt"));
    gesture::write_templates(out, name, set);
    if (!out.flush()) return false;
  }
  std::printf("%s: %zu templates\n", folder.c_str(), set.templates.size());
  return true;
}

int make(const fs::path& out, const std::string& digits, const std::string& skin) {
  std::ifstream in(skin);
  auto model = gesture::read_color_model(in, skin);
  if (!model) {
    std::fprintf(stderr, "%s\n", model.error().message().c_str());
    return 2;
  }
  gesture::SkinSegmenter segmenter(*std::move(model),
                                   {.adaptation = gesture::SkinOptions::Adaptation::image});
  std::vector<BankExample> numerals = simulated_numerals(kNumeralPeople);
  for (const BankExample& one : photographed_numerals(digits, segmenter)) numerals.push_back(one);
  const bool written = write(out / "wearable", bank_of(simulated_wearable(kWearablePeople),
                                                       gesture::linear_rings())) &&
                       write(out / "asl-digits", bank_of(numerals, gesture::fine_rings()));
  return written ? 0 : 3;
}

}  // namespace
}  // namespace armsreach::tools

int main(int argc, char** argv) {
  if (argc == 4) return armsreach::tools::make(argv[1], argv[2], argv[3]);
  std::fprintf(stderr,
               "armsreach_gesture_bank OUT_FOLDER SIGN_LANGUAGE_DIGITS_FOLDER SKIN_MODEL\n");
  return 2;
}
