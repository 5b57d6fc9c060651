// armsreach learn gesture: templates of one gesture from pictures of a hand that makes it.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/gesture_files.hpp"
#include "app/cli/gesture_options.hpp"
#include "vision/gesture/gesture_detector.hpp"

namespace armsreach::app {
namespace {

constexpr const char* kPaperRings = "paper";
constexpr const char* kLinearRings = "linear";

struct LearnGestureOptions {
  std::string name;
  std::vector<std::string> pictures;
  std::string templates;
  std::string vocabulary = "wearable";
  std::string rings;
  SkinSource skin;
};

// As asked for; else the folder's own, so that its templates stay comparable.
Result<gesture::RingLayout> layout_for(const LearnGestureOptions& options) {
  if (options.rings == kPaperRings) return gesture::doubling_rings();
  if (options.rings == kLinearRings) return gesture::fine_rings();
  auto layout = layout_in(options.templates, options.vocabulary);
  if (!layout) return layout.error();
  return layout->value_or(gesture::fine_rings());
}

Status learn(const LearnGestureOptions& options) {
  auto layout = layout_for(options);
  if (!layout) return layout.error();
  gesture::TemplateSet learnt{*layout, {}};
  const gesture::HandFinder finder;
  const auto status =
      for_hand_pictures(options.pictures, options.skin, [&](const HandPicture& picture) -> Status {
        const auto blobs = gesture::find_hands(finder, picture.skins[0], picture.bgr);
        // Who gives the outline knows that it is a hand's, however much of the picture it fills.
        const bool given = !options.skin.masks.empty();
        if (blobs.empty() || (!given && !blobs[0].plausible)) {
          return Error{"no hand is found in it", picture.file,
                       "show one hand before something of another colour, fit the skin's colour "
                       "with `armsreach calibrate skin`, or give its outline with --masks"};
        }
        learnt.templates.push_back(
            gesture::template_of(options.name, blobs[0].readings[0], learnt.layout));
        return ok();
      });
  if (!status) return status;
  if (auto added = add_to_templates(options.templates, options.vocabulary, options.name, learnt);
      !added)
    return added;
  std::printf("%s: learnt from %zu picture%s\n", options.name.c_str(), learnt.templates.size(),
              learnt.templates.size() == 1 ? "" : "s");
  return ok();
}

}  // namespace

void add_learn_gesture(CLI::App& learn_verb, Task* task) {
  CLI::App* command = learn_verb.add_subcommand("gesture", "a hand's gesture from pictures of it");
  auto o = std::make_shared<LearnGestureOptions>();
  command->add_option("name", o->name, "what it is called")->required();
  command->add_option("pictures", o->pictures, "pictures, or folders of them: one hand in each")
      ->required();
  command->add_option("--templates", o->templates, "folder to add it to")->required();
  command->add_option("--vocabulary", o->vocabulary, "the gestures it is told apart from")
      ->capture_default_str();
  command
      ->add_option("--rings", o->rings,
                   "paper: five, radii doubling, 180 samples; linear: sixteen at equal distances, "
                   "90 samples [those of the folder, else linear]")
      ->check(CLI::IsMember({kPaperRings, kLinearRings}));
  add_skin_options(*command, &o->skin);
  command->callback([task, o] { *task = [o] { return learn(*o); }; });
}

}  // namespace armsreach::app
