#include "app/cli/hands_setup.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "app/cli/color_files.hpp"
#include "app/cli/gesture_files.hpp"
#include "render/assets.hpp"
#include "vision/gesture/gesture_detector.hpp"
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

// `mask` with every part made larger by a share of its width on all sides.
cv::Mat grown(const cv::Mat& mask, double share) {
  const int radius = std::max(1, cvRound(share * mask.cols));
  cv::Mat larger;
  cv::dilate(mask, larger,
             cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1}));
  return larger;
}

// Wood and walls have the colour of skin, but are farther away than a wearer's own hand. What has
// no depth may be too near to have one; beside something far it is that one's edge.
cv::Mat within_reach(const cv::Mat& skin, const Frame& frame, double reach) {
  if (frame.depth.empty() || !frame.sensor->registered) return skin;
  const cv::Mat far = frame.depth > reach;
  const cv::Mat near = frame.depth <= reach;
  cv::Mat gone = far | (grown(far, 0.02) & ~grown(near, 0.005));
  if (gone.size() != skin.size()) cv::resize(gone, gone, skin.size(), 0, 0, cv::INTER_NEAREST);
  cv::Mat left = skin.clone();
  left.setTo(0, gone);
  return left;
}

// Looks at one image after the other, on one thread.
class Looking {
 public:
  Looking(gesture::ColorModel skin, const gesture::TemplateSet& templates,
          std::optional<gesture::ColorModel> colors, double reach)
      : skin_(std::move(skin), {.adaptation = gesture::SkinOptions::Adaptation::stream}),
        hands_(templates, gesture::options_for(templates)),
        reach_(reach) {
    if (colors) things_.emplace(*std::move(colors));
  }

  Sighting look(const Frame& frame) {
    const cv::Mat& bgr = frame.color;
    const cv::Mat skin = within_reach(skin_.segment(bgr), frame, reach_);
    return {hands_.detect(skin, bgr), things_ ? things_->find(bgr, skin) : gesture::ColorBlobs()};
  }
  const gesture::RingLayout& rings() const { return hands_.matcher().set().layout; }

 private:
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

Result<HandDetectors> make_detectors(const GestureConfig& config, const std::string& gaze_target,
                                     bool show_rings) {
  auto skin = skin_model(config.skin);
  if (!skin) return skin.error();
  auto templates = load_templates(config.templates, config.vocabulary);
  if (!templates) return templates.error();
  std::optional<gesture::ColorModel> colors;
  if (!config.colours.empty()) {
    auto model = things_model(config.colours);
    if (!model) return model.error();
    colors = *std::move(model);
  }
  if (auto status = check_target(gaze_target, colors); !status) return status.error();
  const auto looking =
      std::make_shared<Looking>(*std::move(skin), *templates, std::move(colors), config.reach);
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
  auto detectors = make_detectors(config, all.gaze.target, all.show.rings);
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
