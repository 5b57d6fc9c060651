// armsreach demo: the guided tour, which needs nothing but this program.
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/commands.hpp"
#include "app/cli/run_options.hpp"
#include "render/context.hpp"

namespace armsreach::app {
namespace {

constexpr std::int64_t kTourFrames = 525;  // nearly once around the bench

Action insert(std::int64_t frame, double x, double y, const char* mesh) {
  Action action;
  action.frame = frame;
  action.click = {x, y};
  action.insert = mesh;
  return action;
}

Action show(std::int64_t frame, const char* layout) {
  Action action;
  action.frame = frame;
  action.layout = layout;
  return action;
}

Config tour() {
  Config config;
  config.width = 1280;
  config.height = 720;
  config.layout = "wearer";
  config.gesture.insert = "cube";
  config.gesture.reach = 0.55;  // the wooden table comes nearer than an arm
  config.actions = {insert(40, 330, 330, "teapot"), insert(65, 456, 335, "cube"),
                    insert(90, 75, 300, "axes"), show(120, "operator"), show(360, "wearer")};
  return config;
}

Status demo(const std::string& out) {
  RunOptions options;
  options.sources = {"sim-hand:sim:bench,script=tour"};
  options.experience = {"workspace", "wearable"};
  if (render::display_exists()) {
    options.display = "window";
    std::printf("The tour runs in a window; close it to end.\n");
    return run(options, tour());
  }
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) return Error{error.message(), out, "give a folder that is yours with --out"};
  const std::filesystem::path folder(out);
  options.pace = "every-frame";
  options.frames = kTourFrames;
  options.record = folder / "demo.mp4";
  options.screenshots = folder / "shots";
  options.trajectory = folder / "trajectory.txt";
  options.events = folder / "events.jsonl";
  options.stats = folder / "stats.json";
  options.map = folder / "map.ot";
  std::filesystem::remove(options.map, error);  // a tour starts afresh
  std::printf("No display here: filming the tour (about a minute).\n");
  const Status status = run(options, tour());
  if (status) {
    std::printf("See %s, stills in %s\n", options.record.c_str(), options.screenshots.c_str());
  }
  return status;
}

}  // namespace

void add_demo_command(CLI::App& app, Task* task) {
  CLI::App* command =
      app.add_subcommand("demo", "the guided tour: a window, or a film without one");
  auto out = std::make_shared<std::string>("out");
  command->add_option("--out", *out, "folder for film and stills")->capture_default_str();
  command->callback([task, out] { *task = [out] { return demo(*out); }; });
}

}  // namespace armsreach::app
