// What the commands that look for gestures take alike: the templates and the skin.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "app/cli/hand_pictures.hpp"

namespace armsreach::app {

struct GestureOptions {
  std::string templates;  // folder; empty: the program's own
  std::string vocabulary = "wearable";
  std::string hands;  // file of their texture; empty: the program's own
  SkinSource skin;
};

void add_skin_options(CLI::App& command, SkinSource* skin);
void add_gesture_options(CLI::App& command, GestureOptions* options);

}  // namespace armsreach::app
