#include "app/cli/hands_setup.hpp"

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "app/cli/color_files.hpp"
#include "app/cli/gesture_files.hpp"
#include "render/assets.hpp"
#include "vision/gesture/gesture_detector.hpp"
#include "vision/gesture/reach.hpp"
#include "vision/gesture/skin_segmenter.hpp"

namespace armsreach::app {
namespace {

Result<gesture::GestureTable> read_table(const std::string& path) {
  if (path.empty()) {
    constexpr const char* kOwn = "gestures/transitions.yaml";
    std::istringstream in{std::string(render::asset(kOwn))};
    return gesture::read_gesture_table(in, kOwn);
  }
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path))
    return Error{"cannot be opened", path, "check gesture.table in the configuration"};
  return gesture::read_gesture_table(in, path);
}

// A gesture that is misspelt would never come.
Status check_gestures(const gesture::GestureTable& table, const gesture::TemplateSet& templates,
                      const std::string& where) {
  std::set<std::string> known{gesture::kNothing, gesture::kGone};
  for (const gesture::GestureTemplate& one : templates.templates) known.insert(one.gesture);
  for (const auto& transition : table.transitions) {
    if (known.count(transition.on)) continue;
    std::string names;
    for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
    return Error{"a transition is on '" + transition.on + "', of which there is no template", where,
                 "known here: " + names + "; see gesture.vocabulary and gesture.templates"};
  }
  return ok();
}

// Looks at one image after the other, on one thread.
class Looking {
 public:
  Looking(gesture::ColorModel skin, const KnownGestures& known,
          std::optional<gesture::ColorModel> colors, double reach)
      : skin_(std::move(skin), {.adaptation = gesture::SkinOptions::Adaptation::stream}),
        hands_(known.templates, known.options),
        reach_(reach) {
    if (colors) things_.emplace(*std::move(colors));
  }

  Sighting look(const Frame& frame) {
    const cv::Mat& bgr = frame.color;
    const cv::Mat skin = within_reach(skin_.segment(bgr), frame);
    auto hands = hands_.detect(skin, bgr);
    if (skin_.adapted() && !gesture::any_told(hands)) {
      // As GestureDetector does with several masks; the second is rarely needed.
      auto others = hands_.detect(within_reach(skin_.segment_unadapted(bgr), frame), bgr);
      if (gesture::any_told(others)) hands = std::move(others);
    }
    return {std::move(hands), things_ ? things_->find(bgr, skin) : gesture::ColorBlobs()};
  }
  const gesture::RingLayout& rings() const { return hands_.matcher().set().layout; }

 private:
  cv::Mat within_reach(const cv::Mat& skin, const Frame& frame) const {
    const bool known = !frame.depth.empty() && frame.sensor->registered;
    return known ? gesture::within_reach(skin, frame.depth, reach_) : skin;
  }

  gesture::SkinSegmenter skin_;
  gesture::GestureDetector hands_;
  double reach_;  // m
  std::optional<gesture::ColorBlobFinder> things_;
};

constexpr const char* kColorTarget = "colour:";

Status check_target(const std::string& target, const std::optional<gesture::ColorModel>& colors) {
  if (target.rfind(kColorTarget, 0) != 0) return ok();
  const std::string name = target.substr(std::string(kColorTarget).size());
  if (colors && gesture::class_named(*colors, name) >= 0) return ok();
  return Error{"nothing is known by the name '" + name + "'", "gaze.target",
               "give gesture.colours a file that `learn colour " + name + "` has written to"};
}

Result<HandDetectors> make_detectors(const GestureConfig& config, const KnownGestures& known,
                                     const std::string& gaze_target, bool show_rings) {
  auto skin = skin_model(config.skin);
  if (!skin) return skin.error();
  std::optional<gesture::ColorModel> colors;
  if (!config.colours.empty()) {
    auto model = things_model(config.colours);
    if (!model) return model.error();
    colors = *std::move(model);
  }
  if (auto status = check_target(gaze_target, colors); !status) return status.error();
  const auto looking =
      std::make_shared<Looking>(*std::move(skin), known, std::move(colors), config.reach);
  HandDetectors detectors;
  if (show_rings)
    detectors.rings.assign(looking->rings().radii.begin(), looking->rings().radii.end());
  detectors.look = [looking](const Frame& frame) { return looking->look(frame); };
  return detectors;
}

}  // namespace

std::optional<FaultEvent> cannot_follow(const GazeConfig& gaze, bool gimbal) {
  const bool automatic = gaze.mode == "auto" && gaze.target == "hand";
  if (automatic || gaze.mode == "rest" || gimbal) return std::nullopt;
  return FaultEvent{"gaze", "the camera is on no gimbal: it cannot turn",
                    "give a rig with a gimbal, or a simulated source with gimbal=yes, or remove "
                    "gaze from the configuration"};
}

Result<HandsSetup> make_hands_setup(const Config& all) {
  const GestureConfig& config = all.gesture;
  auto table = read_table(config.table);
  if (!table) return table.error();
  auto known = load_gestures(config.templates, config.vocabulary, config.hands);
  if (!known) return known.error();
  // The program's own table names more than every vocabulary has.
  if (!config.table.empty()) {
    if (auto status = check_gestures(*table, known->templates, config.table); !status)
      return status.error();
  }
  auto detectors = make_detectors(config, *known, all.gaze.target, all.show.rings);
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
