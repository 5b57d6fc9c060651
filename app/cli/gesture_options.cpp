#include "app/cli/gesture_options.hpp"

namespace armsreach::app {

void add_skin_options(CLI::App& command, SkinSource* skin) {
  command.add_option("--skin", skin->model, "skin model, from `calibrate skin`");
  command.add_option("--masks", skin->masks, "folder of masks of the skin, PNG by name");
}

void add_gesture_options(CLI::App& command, GestureOptions* options) {
  command.add_option("--templates", options->templates,
                     "folder that `learn gesture` wrote; without it the program's own");
  command
      .add_option("--vocabulary", options->vocabulary, "the program knows wearable and asl-digits")
      ->capture_default_str();
  command.add_option("--hands", options->hands,
                     "what hands look like, from `learn hands`; without it the program's own");
  add_skin_options(command, &options->skin);
}

}  // namespace armsreach::app
