// armsreach: parses the command line, runs one verb, turns its result into an exit code:
// 0 done, 2 the command or a file is wrong, 3 a source or device failed.
#include <cstdio>
#include <exception>

#include <opencv2/core/utility.hpp>

#include "app/cli/commands.hpp"

namespace {

constexpr int kWrongInput = 2;
constexpr int kDeviceFailed = 3;

int exit_code(const armsreach::Error& error) {
  return error.kind == armsreach::Error::Kind::input ? kWrongInput : kDeviceFailed;
}

int run_task(const armsreach::app::Task& task) {
  try {
    const armsreach::Status status = task();
    if (status) return 0;
    std::fprintf(stderr, "armsreach: %s\n", status.error().message().c_str());
    return exit_code(status.error());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "armsreach: failed: %s\n", e.what());
    return kDeviceFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);  // our stages are the threads; and results must not depend on scheduling
  CLI::App app("Hand-reach augmented reality on ordinary cameras.", "armsreach");
  app.require_subcommand(1);
  app.set_version_flag("--version", ARMSREACH_VERSION);
  app.set_help_all_flag("--help-all", "help of every verb");
  armsreach::app::Task task;
  armsreach::app::add_run_command(app, &task);
  armsreach::app::add_record_command(app, &task);
  armsreach::app::add_demo_command(app, &task);
  armsreach::app::add_sources_command(app, &task);
  armsreach::app::add_export_command(app, &task);
  armsreach::app::add_evaluate_command(app, &task);
  armsreach::app::add_learn_command(app, &task);
  armsreach::app::add_detect_command(app, &task);
  armsreach::app::add_calibrate_command(app, &task);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : kWrongInput;
  }
  return run_task(task);
}
