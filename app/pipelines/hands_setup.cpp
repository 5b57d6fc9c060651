#include "app/pipelines/hands_setup.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "render/assets.hpp"

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

}  // namespace

Result<HandsSetup> make_hands_setup(const GestureConfig& config, const ShowConfig&) {
  auto table = read_table(config.table);
  if (!table) return table.error();
  HandsSetup setup;
  setup.inference.table = *std::move(table);
  setup.inference.window = config.window;
  setup.inference.cursor.enabled = config.cursor_filter.enabled;
  setup.inference.cursor.min_cutoff = config.cursor_filter.min_cutoff;
  setup.inference.cursor.beta = config.cursor_filter.beta;
  setup.detectors.hands = [](const cv::Mat&) { return gesture::HandObservations(); };
  return setup;
}

}  // namespace armsreach::app
