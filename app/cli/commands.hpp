// The verbs of the command line. Each adds its options to the program and, when it was chosen,
// leaves its task to be run.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "vision/core/result.hpp"

namespace armsreach::app {

using Task = std::function<Status()>;

void add_run_command(CLI::App& app, Task* task);
void add_record_command(CLI::App& app, Task* task);
void add_demo_command(CLI::App& app, Task* task);
void add_sources_command(CLI::App& app, Task* task);
void add_export_command(CLI::App& app, Task* task);
void add_evaluate_command(CLI::App& app, Task* task);
void add_learn_command(CLI::App& app, Task* task);
void add_detect_command(CLI::App& app, Task* task);
void add_calibrate_command(CLI::App& app, Task* task);

// Nouns of these verbs (verbs.cpp).
void add_evaluate_gestures(CLI::App& evaluate, Task* task);
void add_evaluate_trajectory(CLI::App& evaluate, Task* task);
void add_calibrate_camera(CLI::App& calibrate, Task* task);
void add_calibrate_target(CLI::App& calibrate, Task* task);
void add_evaluate_gaze(CLI::App& evaluate, Task* task);
void add_learn_gesture(CLI::App& learn, Task* task);
void add_learn_hands(CLI::App& learn, Task* task);
void add_detect_gestures(CLI::App& detect, Task* task);
void add_calibrate_skin(CLI::App& calibrate, Task* task);
void add_learn_color(CLI::App& learn, Task* task);
void add_detect_colors(CLI::App& detect, Task* task);

}  // namespace armsreach::app
