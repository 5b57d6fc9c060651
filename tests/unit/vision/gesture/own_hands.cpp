#include "tests/unit/vision/gesture/own_hands.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "vision/gesture/color_model_yaml.hpp"

namespace armsreach::test {
namespace {

namespace fs = std::filesystem;

const fs::path kAssets = fs::path(ARMSREACH_SOURCE_DIR) / "assets";

}  // namespace

gesture::TemplateSet own_templates(const std::string& vocabulary) {
  gesture::TemplateSet set;
  for (const auto& entry : fs::directory_iterator(kAssets / "gestures" / vocabulary)) {
    std::ifstream in(entry.path());
    EXPECT_TRUE(
        gesture::read_templates(in, entry.path().stem().string(), entry.path().string(), &set));
  }
  return set;
}

gesture::TextureModel own_texture() {
  const fs::path path = kAssets / "gestures/hands.txt";
  std::ifstream in(path);
  auto model = gesture::read_texture_model(in, path.string());
  EXPECT_TRUE(model.ok());
  return *model;
}

gesture::SkinSegmenter own_segmenter() {
  const fs::path path = kAssets / "skin/default.yaml";
  std::ifstream in(path);
  auto model = gesture::read_color_model(in, path.string());
  EXPECT_TRUE(model.ok());
  return gesture::SkinSegmenter(*model, {.adaptation = gesture::SkinOptions::Adaptation::image});
}

}  // namespace armsreach::test
