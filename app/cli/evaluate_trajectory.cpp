// armsreach evaluate trajectory: how far an estimated trajectory is from the truth.
#include <cstdio>
#include <deque>
#include <fstream>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/runtime/output_file.hpp"
#include "devices/open.hpp"
#include "vision/core/depth_consistency.hpp"
#include "vision/core/trajectory.hpp"

namespace armsreach::app {
namespace {

struct EvaluateOptions {
  std::string estimate;
  std::string truth;
  bool with_scale = false;
  std::string recording;
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

// Depth of each frame seen from the frame a second later, under the estimated poses: the median of
// |dz| / z^2 [1/m] over the recording. A property of the trajectory alone, whatever the truth says.
Result<double> reprojected_depth(const std::string& folder, const Trajectory& trajectory) {
  constexpr size_t kFramesOn = 30;
  constexpr int kStep = 8;  // px: 4800 samples a frame
  auto spec = parse_source_spec("tum:" + folder);
  if (!spec) return spec.error();
  auto source = open_source(*spec, {});
  if (!source) return source.error();
  if (!(*source)->sensor()->depth_camera) {
    return Error{"has no depth", folder, "give a recording with depth"};
  }
  const Camera& camera = *(*source)->sensor()->depth_camera;
  std::deque<std::pair<Pose, cv::Mat>> window;
  std::vector<float> differences;
  for (;;) {
    auto frame = (*source)->next();
    if (!frame) return frame.error();
    if (!*frame) break;
    const auto pose = pose_at(trajectory, (*frame)->time);
    if (!pose || (*frame)->depth.empty()) continue;
    window.emplace_back(*pose, (*frame)->depth);
    if (window.size() <= kFramesOn) continue;
    add_depth_differences(window.front().second, window.back().second, camera,
                          window.back().first.inverse() * window.front().first, kStep,
                          &differences);
    window.pop_front();
  }
  if (differences.empty()) {
    return Error{"fewer than 31 frames have a pose", folder,
                 "check that the times belong together"};
  }
  return static_cast<double>(median(&differences));
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

Status evaluate_files(const EvaluateOptions& options) {
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
  nlohmann::json json = json_from_errors(*errors);
  if (!options.recording.empty()) {
    auto reprojected = reprojected_depth(options.recording, *estimate);
    if (!reprojected) return reprojected.error();
    std::printf("depth 30 frames on   %.2e 1/m (median |dz| / z^2)\n", *reprojected);
    json["reprojected_depth"] = *reprojected;
  }
  return write_file(options.json, [&](std::ostream& out) { out << json.dump(2) << "\n"; });
}

}  // namespace

void add_evaluate_trajectory(CLI::App& evaluate, Task* task) {
  CLI::App* command = evaluate.add_subcommand(
      "trajectory", "absolute and relative errors of a trajectory (TUM format)");
  auto options = std::make_shared<EvaluateOptions>();
  command->add_option("--estimate", options->estimate, "trajectory to judge")->required();
  command->add_option("--truth", options->truth, "true trajectory")->required();
  command->add_flag("--scale", options->with_scale, "align with a free scale (Sim3)");
  command->add_option("--recording", options->recording,
                      "TUM folder: also reproject its depth 30 frames on");
  command->add_option("--json", options->json, "write the figures here");
  command->callback([task, options] { *task = [options] { return evaluate_files(*options); }; });
}

}  // namespace armsreach::app
