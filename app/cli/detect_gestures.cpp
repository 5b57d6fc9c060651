// armsreach detect gestures: hands and the gestures they make, as JSON.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/gesture_files.hpp"
#include "app/cli/gesture_options.hpp"
#include "app/runtime/output_file.hpp"
#include "vision/gesture/gesture_detector.hpp"

namespace armsreach::app {
namespace {

struct DetectGesturesOptions {
  std::vector<std::string> places;
  GestureOptions gestures;
  std::string json;
};

nlohmann::json json_from_hand(const HandPicture& picture, const gesture::HandObservation& hand) {
  // Pixels of the file.
  const double scale = 1.0 / picture.enlarged;
  const auto in_file = [&](double at) { return (at + 0.5) * scale - 0.5; };
  nlohmann::json json = {{"file", picture.file},
                         {"frame", picture.frame},
                         {"hand", hand.hand},
                         {"gesture", nullptr},
                         {"score", hand.score},
                         {"angle", hand.angle},
                         {"x", in_file(hand.center.x())},
                         {"y", in_file(hand.center.y())},
                         {"tip_x", in_file(hand.fingertip.x())},
                         {"tip_y", in_file(hand.fingertip.y())},
                         {"area", hand.area * scale * scale},
                         {"scores", hand.scores}};
  if (hand.gesture) json["gesture"] = *hand.gesture;
  return json;
}

Status detect(const DetectGesturesOptions& options) {
  auto known = load_gestures(options.gestures.templates, options.gestures.vocabulary,
                             options.gestures.hands);
  if (!known) return known.error();
  const gesture::GestureDetector detector(std::move(known->templates), known->options);
  nlohmann::json all = nlohmann::json::array();
  const auto status = for_readable_hand_pictures(
      options.places, options.gestures.skin, [&](const HandPicture& picture) {
        for (const auto& hand : detector.detect(picture.skins, picture.bgr))
          all.push_back(json_from_hand(picture, hand));
      });
  if (!status) return status;
  return write_file(options.json, [&](std::ostream& out) { out << all.dump(1) << "\n"; });
}

}  // namespace

void add_detect_gestures(CLI::App& detect_verb, Task* task) {
  CLI::App* command = detect_verb.add_subcommand("gestures", "hands and their gestures");
  auto o = std::make_shared<DetectGesturesOptions>();
  command->add_option("places", o->places, "images, videos, or folders of them")->required();
  add_gesture_options(*command, &o->gestures);
  command->add_option("--json", o->json, "write what was found here")->required();
  command->callback([task, o] { *task = [o] { return detect(*o); }; });
}

}  // namespace armsreach::app
