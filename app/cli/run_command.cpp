// armsreach run: the command line of a run.
#include <memory>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/rig_options.hpp"
#include "app/cli/run_options.hpp"

namespace armsreach::app {

void add_run_command(CLI::App& app, Task* task) {
  CLI::App* command = app.add_subcommand("run", "augment a live or recorded sensor");
  auto o = std::make_shared<RunOptions>();
  auto* source = command->add_option(
      "--source", o->sources, "what to look through: SPEC or NAME=SPEC, see `armsreach sources`");
  command->add_option("--rig", o->rig, "YAML file of named sensors")->excludes(source);
  command
      ->add_option("--experience", o->experience,
                   "workspace, wearable or both; default: workspace where there is depth or a map")
      ->delimiter(',')
      ->check(CLI::IsMember({"workspace", "wearable"}));
  command->add_option("--camera", o->camera, "camera YAML in place of the source's own");
  command->add_option("--display", o->display, "where to draw")
      ->check(CLI::IsMember({"auto", "window", "egl", "osmesa", "none"}))
      ->capture_default_str();
  command->add_option("--pace", o->pace, "live skips stale frames, every-frame drops nothing")
      ->check(CLI::IsMember({"live", "every-frame"}))
      ->capture_default_str();
  command->add_option("--frames", o->frames, "stop after so many")->check(at_least_one, "COUNT");
  command->add_option("--record", o->record, "film (H.264 mp4)");
  command->add_option("--screenshots", o->screenshots, "folder for a PNG a second, and the last");
  command->add_option("--trajectory", o->trajectory, "camera poses in TUM format");
  command->add_option("--events", o->events, "events, one JSON object a line");
  command->add_option("--stats", o->stats, "statistics as JSON");
  auto* map = command->add_option(
      "--map", o->map, "map to go on with if the file exists, and to save (OctoMap .ot)");
  command
      ->add_option("--session", o->session,
                   "folder to go on with and to save: map, key frames, objects")
      ->excludes(map);
  command->add_option("--config", o->config, "YAML, see 'Configuration' in the README");
  command->add_option("--seed", o->seed, "of everything random")->capture_default_str();
  command->callback([task, o] { *task = [o] { return run(*o); }; });
}

}  // namespace armsreach::app
