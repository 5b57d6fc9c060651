// The verbs that are followed by a noun: what is evaluated, learnt, detected or calibrated.
#include "app/cli/commands.hpp"

namespace armsreach::app {
namespace {

CLI::App& verb(CLI::App& app, const char* name, const char* what) {
  CLI::App* command = app.add_subcommand(name, what);
  command->require_subcommand(1);
  return *command;
}

}  // namespace

void add_evaluate_command(CLI::App& app, Task* task) {
  CLI::App& evaluate = verb(app, "evaluate", "measure results against the truth");
  add_evaluate_gestures(evaluate, task);
  add_evaluate_trajectory(evaluate, task);
  add_evaluate_gaze(evaluate, task);
}

void add_learn_command(CLI::App& app, Task* task) {
  CLI::App& learn = verb(app, "learn", "teach it something from examples");
  add_learn_color(learn, task);
  add_learn_gesture(learn, task);
  add_learn_hands(learn, task);
}

void add_detect_command(CLI::App& app, Task* task) {
  CLI::App& detect = verb(app, "detect", "find something in images and say where as JSON");
  add_detect_colors(detect, task);
  add_detect_gestures(detect, task);
}

void add_calibrate_command(CLI::App& app, Task* task) {
  CLI::App& calibrate = verb(app, "calibrate", "fit it to a camera, a user, a place");
  add_calibrate_camera(calibrate, task);
  add_calibrate_target(calibrate, task);
  add_calibrate_skin(calibrate, task);
}

}  // namespace armsreach::app
