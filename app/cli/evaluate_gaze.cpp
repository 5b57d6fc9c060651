// armsreach evaluate gaze: how well the camera on its gimbal follows, leaps and holds.
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/rig_options.hpp"
#include "app/evaluation/gaze_figures.hpp"
#include "app/evaluation/gaze_trial.hpp"
#include "app/evaluation/time_plot.hpp"
#include "app/runtime/output_file.hpp"

namespace armsreach::app {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct EvaluateGazeOptions {
  std::string source = "sim:gaze,mount=shoulder,gimbal=yes,lens=80";
  std::string mode = "follow";
  GazeTrial trial;
  std::string json;
  std::string plots;
};

void print(const HoldFigures& f) {
  std::printf("in the central half  %.1f %% of the frames\n", 100 * f.central);
  std::printf("off the target       %.2f deg rms, %.2f deg at most\n", kDegrees * f.rms,
              kDegrees * f.largest);
  std::printf("off the horizon      %.2f deg rms\n", kDegrees * f.torsion_rms);
  std::printf("the target moved at  up to %.2f m/s, %.2f rad/s seen from the mount\n",
              f.target_speed, f.bearing_speed);
  std::printf("the mount moved at   %.2f m/s rms\n", f.mount_speed);
}

void print(const StepFigures& f) {
  if (f.steps == 0) return;
  std::printf(
      "after %d steps of up to %.1f deg: overshoot %.2f deg, %d crossings, settled in %.2f "
      "s at most\n",
      f.steps, kDegrees * f.size, kDegrees * f.overshoot, f.crossings, f.settled);
}

void print(const std::vector<SaccadeFigures>& saccades) {
  std::printf("  begins      off   beyond the edge   arrived    error\n");
  for (const SaccadeFigures& one : saccades) {
    std::printf("%6.2f s  %5.1f deg       %5.1f deg     ", one.begins, kDegrees * one.off,
                kDegrees * one.beyond_edge);
    if (one.arrived) {
      std::printf("%.2f s", *one.arrived);
    } else {
      std::printf("never ");
    }
    std::printf("  %5.2f deg\n", kDegrees * one.error);
  }
}

TimePlot plot_of(const GazeRun& run, const std::string& title) {
  TimePlot plot{title, {}, {}};
  TimeCurve off{"off the target", {}};
  TimeCurve torsion{"off the horizon", {}};
  std::vector<TimeCurve> axes{{"pan", {}}, {"tilt", {}}, {"roll", {}}};
  std::vector<TimeCurve> target{{"to the right", {}}, {"downwards", {}}};
  for (const GazeSample& sample : run.samples) {
    plot.times.push_back(sample.time);
    off.values.push_back(kDegrees * sample.off);
    torsion.values.push_back(kDegrees * sample.torsion);
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      axes[static_cast<std::size_t>(axis)].values.push_back(kDegrees * sample.angles[axis]);
    target[0].values.push_back(kDegrees * sample.bearing.x());
    target[1].values.push_back(kDegrees * sample.bearing.y());
  }
  plot.panels = {{"axes of the gimbal / deg", axes},
                 {"bearing of the target / deg", target},
                 {"errors / deg", {off, torsion}}};
  return plot;
}

Status write_plot(const EvaluateGazeOptions& options, const GazeRun& run) {
  if (options.plots.empty()) return ok();
  std::error_code failure;
  std::filesystem::create_directories(options.plots, failure);
  if (failure) return Error{failure.message(), options.plots, "give a folder to write to"};
  const std::string file = options.plots + "/gaze-" + options.mode + ".svg";
  char title[128];
  std::snprintf(title, sizeof(title), "Gaze: %s, measurements %.0f ms late", options.mode.c_str(),
                1000 * options.trial.delay);
  return write_file(file, [&](std::ostream& out) { write_svg(out, plot_of(run, title)); });
}

Status evaluate_gaze(EvaluateGazeOptions options) {
  if (options.trial.targets.empty()) {
    options.trial.targets = options.mode == "follow"
                                ? std::vector<std::string>{"hand"}
                                : std::vector<std::string>{"mug", "clock", "mug", "vase"};
  }
  RigOptions rig_options;
  rig_options.sources = {options.source};
  auto rig = open_rig(rig_options);
  if (!rig) return rig.error();
  auto run = run_gaze_trial(**rig, options.trial);
  if (!run) return run.error();
  nlohmann::json json{{"mode", options.mode}, {"delay", options.trial.delay}};
  if (options.trial.mode == GazeMode::saccade) {
    const auto saccades = saccade_figures(*run);
    print(saccades);
    for (const SaccadeFigures& one : saccades) json["saccades"].push_back(json_from(one));
  } else {
    const HoldFigures hold = hold_figures(*run);
    const StepFigures steps = step_figures(*run);
    print(hold);
    print(steps);
    json["hold"] = json_from(hold);
    json["steps"] = json_from(steps);
  }
  if (auto status = write_plot(options, *run); !status) return status;
  return write_file(options.json, [&](std::ostream& out) { out << json.dump(2) << "\n"; });
}

}  // namespace

void add_evaluate_gaze(CLI::App& evaluate, Task* task) {
  CLI::App* command = evaluate.add_subcommand(
      "gaze", "a simulated camera on its gimbal: follow, saccade, fixate with late measurements");
  auto options = std::make_shared<EvaluateGazeOptions>();
  const std::map<std::string, GazeMode> modes{
      {"follow", GazeMode::follow}, {"saccade", GazeMode::saccade}, {"fixate", GazeMode::fixate}};
  command->add_option("--source", options->source, "simulated camera with a gimbal")
      ->capture_default_str();
  command->add_option("--mode", options->mode, "follow, saccade or fixate")
      ->check(CLI::IsMember(modes))
      ->capture_default_str();
  command
      ->add_option("--target", options->trial.targets,
                   "thing or hand to look at; several for saccades")
      ->delimiter(',');
  command->add_option("--delay", options->trial.delay, "s by which measurements are late")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--json", options->json, "write the figures here");
  command->add_option("--plots", options->plots, "write gaze-MODE.svg into this folder");
  command->callback([task, options, modes] {
    options->trial.mode = modes.at(options->mode);
    *task = [options] { return evaluate_gaze(*options); };
  });
}

}  // namespace armsreach::app
