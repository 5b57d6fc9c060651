#include "tests/unit/vision/gaze/closed_loop.hpp"

#include <cmath>
#include <deque>

#include "vision/core/gimbal_motion.hpp"

namespace armsreach {
namespace {

LoopSample sample_of(const Pose& world_from_camera, const Eigen::Vector3d& target_in_world) {
  LoopSample sample;
  const Eigen::Vector3d target = world_from_camera.inverse() * target_in_world;
  sample.off = std::atan2(target.head<2>().norm(), target.z());
  sample.bearing = {std::atan2(target.x(), target.z()), std::atan2(target.y(), target.z())};
  sample.torsion = std::asin((world_from_camera.rotation() * Eigen::Vector3d::UnitX()).z());
  return sample;
}

}  // namespace

std::vector<LoopSample> run(const Loop& loop, const Commander& commander,
                            const std::function<GazeMode()>& mode) {
  GimbalMotion motion(loop.model);
  std::deque<GazeInput> under_way;
  std::vector<LoopSample> samples;
  for (int i = 0; i < loop.rate * loop.seconds; ++i) {
    const double time = i / loop.rate;
    const Timestamp now = timestamp_from_seconds(time);
    const GimbalState state = motion.advance(now);
    const Pose world_from_camera =
        loop.world_from_mount(time) * mount_from_camera(loop.model, state.angles);
    const Eigen::Vector3d target = loop.target_in_world(time);

    GazeInput taken;
    taken.now = now;
    taken.pose = CameraPoseSeen{now, world_from_camera};
    if (const auto pixel = project(loop.camera, world_from_camera.inverse() * target);
        pixel && loop.camera.contains(*pixel)) {
      taken.target = TargetSeen{now, *pixel, std::nullopt};
    }
    under_way.push_back(taken);

    GazeInput input;
    if (seconds_from_timestamp(now - under_way.front().now) >= loop.delay - 1e-6) {
      input = under_way.front();
      under_way.pop_front();
    }
    input.now = now;
    input.gimbal = state;
    motion.command(commander(input));

    samples.push_back(sample_of(world_from_camera, target));
    samples.back().time = time;
    samples.back().angles = state.angles;
    samples.back().mode = mode();
  }
  return samples;
}

std::vector<LoopSample> run(const Loop& loop, GazeController& controller,
                            const std::function<void(double)>& instruct) {
  const auto step = [&](const GazeInput& input) {
    instruct(seconds_from_timestamp(input.now));
    return controller.step(input);
  };
  return run(loop, step, [&] { return controller.mode(); });
}

double rms_off(const std::vector<LoopSample>& samples, double from, double to) {
  double sum = 0;
  int count = 0;
  for (const LoopSample& sample : samples) {
    if (sample.time < from || sample.time >= to) continue;
    sum += sample.off * sample.off;
    ++count;
  }
  return std::sqrt(sum / count);
}

}  // namespace armsreach
