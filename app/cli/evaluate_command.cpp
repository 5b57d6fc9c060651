// armsreach evaluate trajectory: how far an estimated trajectory is from the truth.
#include <fstream>
#include <iostream>
#include <numbers>

#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "vision/core/trajectory.hpp"

namespace armsreach::app {
namespace {

struct EvaluateOptions {
  std::string estimate;
  std::string truth;
  bool with_scale = false;
  std::string json;
};

Result<Trajectory> read_trajectory(const std::string& path) {
  std::ifstream in(path);
  if (!in) return Error{"cannot be opened", path, "give a file in TUM format"};
  return read_tum_trajectory(in, path);
}

nlohmann::json json_from_errors(const TrajectoryErrors& e) {
  return {{"pairs", e.pairs},
          {"coverage", e.coverage},
          {"scale", e.alignment.scale},
          {"ate_rmse", e.ate_rmse},
          {"ate_max", e.ate_max},
          {"rpe_frame_translation", e.rpe_frame_translation},
          {"rpe_frame_rotation", e.rpe_frame_rotation},
          {"rpe_second_translation", e.rpe_second_translation},
          {"rpe_second_rotation", e.rpe_second_rotation}};
}

void print(const TrajectoryErrors& e) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  std::printf("poses compared       %d (coverage %.1f %%)\n", e.pairs, 100 * e.coverage);
  std::printf("ATE rmse             %.3f cm\n", 100 * e.ate_rmse);
  std::printf("ATE max              %.3f cm\n", 100 * e.ate_max);
  std::printf("RPE per frame        %.3f cm  %.3f deg\n", 100 * e.rpe_frame_translation,
              kDegrees * e.rpe_frame_rotation);
  std::printf("RPE per second       %.3f cm  %.3f deg\n", 100 * e.rpe_second_translation,
              kDegrees * e.rpe_second_rotation);
  std::printf("scale                %.4f\n", e.alignment.scale);
}

Status evaluate(const EvaluateOptions& options) {
  auto estimate = read_trajectory(options.estimate);
  if (!estimate) return estimate.error();
  auto truth = read_trajectory(options.truth);
  if (!truth) return truth.error();
  const auto errors = trajectory_errors(*estimate, *truth, options.with_scale);
  if (!errors) {
    return Error{"fewer than 3 poses have a partner in " + options.truth + " within 20 ms",
                 options.estimate, "check that both use the recording's times"};
  }
  print(*errors);
  if (options.json.empty()) return ok();
  std::ofstream out(options.json);
  out << json_from_errors(*errors).dump(2) << "\n";
  if (!out.flush()) return Error{"cannot be written", options.json, "check folder and disk"};
  return ok();
}

}  // namespace

void add_evaluate_command(CLI::App& app, Task* task) {
  CLI::App* command = app.add_subcommand("evaluate", "measure results against the truth");
  command->require_subcommand(1);
  CLI::App* trajectory = command->add_subcommand(
      "trajectory", "absolute and relative errors of a trajectory (TUM format)");
  auto options = std::make_shared<EvaluateOptions>();
  trajectory->add_option("--estimate", options->estimate, "trajectory to judge")->required();
  trajectory->add_option("--truth", options->truth, "true trajectory")->required();
  trajectory->add_flag("--scale", options->with_scale, "align with a free scale (Sim3)");
  trajectory->add_option("--json", options->json, "write the figures here");
  trajectory->callback([task, options] { *task = [options] { return evaluate(*options); }; });
}

}  // namespace armsreach::app
