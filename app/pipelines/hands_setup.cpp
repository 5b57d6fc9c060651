#include "app/pipelines/hands_setup.hpp"

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "render/assets.hpp"
#include "vision/gesture/color_model_yaml.hpp"
#include "vision/gesture/gesture_detector.hpp"
#include "vision/gesture/skin_segmenter.hpp"

namespace armsreach::app {
namespace {

// A file, or where none is named the asset of the program, opened for reading.
Result<std::unique_ptr<std::istream>> open_or_asset(const std::string& path, const char* asset) {
  if (path.empty()) return std::make_unique<std::istringstream>(std::string(render::asset(asset)));
  auto file = std::make_unique<std::ifstream>(path);
  if (!*file || std::filesystem::is_directory(path))
    return Error{"cannot be opened", path, "check the path in the configuration"};
  return std::unique_ptr<std::istream>(std::move(file));
}

Result<gesture::GestureTable> read_table(const std::string& path) {
  auto in = open_or_asset(path, "gestures/transitions.yaml");
  if (!in) return in.error();
  return gesture::read_gesture_table(**in, path.empty() ? "gestures/transitions.yaml" : path);
}

Result<gesture::ColorModel> read_skin(const std::string& path) {
  auto in = open_or_asset(path, "skin/default.yaml");
  if (!in) return in.error();
  return gesture::read_color_model(**in, path.empty() ? "skin/default.yaml" : path);
}

// One file a gesture, named after it, in name order.
Result<gesture::TemplateSet> read_templates(const GestureConfig& config) {
  std::filesystem::path folder = config.templates;
  if (std::filesystem::is_directory(folder / config.vocabulary)) folder /= config.vocabulary;
  std::set<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.is_regular_file()) files.insert(entry.path());
  }
  gesture::TemplateSet set;
  for (const std::filesystem::path& file : files) {
    std::ifstream in(file);
    if (auto status = gesture::read_templates(in, file.stem(), file, &set); !status)
      return status.error();
  }
  if (set.templates.empty()) {
    return Error{"holds no templates of gestures", folder,
                 "learn some with `armsreach learn gesture`, or leave gesture.templates away"};
  }
  return set;
}

// Looks at one image after the other, on one thread.
class Looking {
 public:
  Looking(gesture::ColorModel skin, gesture::TemplateSet templates,
          std::optional<gesture::ColorModel> colors)
      : skin_(std::move(skin)), hands_(std::move(templates)) {
    if (colors) things_.emplace(*std::move(colors));
  }

  Sighting look(const cv::Mat& bgr) {
    const cv::Mat& skin = skin_.segment(bgr);
    return {hands_.detect(skin), things_ ? things_->find(bgr, skin) : gesture::ColorBlobs()};
  }
  const gesture::RingLayout& rings() const { return hands_.matcher().set().layout; }

 private:
  gesture::SkinSegmenter skin_;
  gesture::GestureDetector hands_;
  std::optional<gesture::ColorBlobFinder> things_;
};

Result<HandDetectors> make_detectors(const GestureConfig& config, bool show_rings) {
  auto skin = read_skin(config.skin);
  if (!skin) return skin.error();
  auto templates = read_templates(config);
  if (!templates) return templates.error();
  std::optional<gesture::ColorModel> colors;
  if (!config.colours.empty()) {
    auto in = open_or_asset(config.colours, "");
    if (!in) return in.error();
    auto model = gesture::read_color_model(**in, config.colours);
    if (!model) return model.error();
    colors = *std::move(model);
  }
  auto looking =
      std::make_shared<Looking>(*std::move(skin), *std::move(templates), std::move(colors));
  HandDetectors detectors;
  if (show_rings)
    detectors.rings.assign(looking->rings().radii.begin(), looking->rings().radii.end());
  detectors.look = [looking](const cv::Mat& bgr) { return looking->look(bgr); };
  return detectors;
}

}  // namespace

Result<HandsSetup> make_hands_setup(const GestureConfig& config, const ShowConfig& show) {
  auto table = read_table(config.table);
  if (!table) return table.error();
  auto detectors = make_detectors(config, show.rings);
  if (!detectors) return detectors.error();
  HandsSetup setup;
  setup.detectors = *std::move(detectors);
  setup.inference.table = *std::move(table);
  setup.inference.window = config.window;
  setup.inference.cursor.enabled = config.cursor_filter.enabled;
  setup.inference.cursor.min_cutoff = config.cursor_filter.min_cutoff;
  setup.inference.cursor.beta = config.cursor_filter.beta;
  return setup;
}

}  // namespace armsreach::app
