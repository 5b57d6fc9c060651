// The active camera in the simulator, closed through what the camera itself sees: no pose is told.
#include <cmath>
#include <deque>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "app/pipelines/gaze_stage.hpp"
#include "app/pipelines/mono_stage.hpp"
#include "devices/rig.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/truth.hpp"

namespace armsreach::app {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kDelay = 3;   // frames from a picture to the command that comes of it
constexpr int kStart = 45;  // frame whose picture the gaze begins with
constexpr int kFrames = 210;

struct Loop {
  std::vector<double> off;  // rad, in truth, of every frame
  int lost = 0;
  Events events;
};

// To a point `pan` to the right of where the camera looked first, 2 m away, while its wearer sways
// at 0.2 m/s. The scale is that of the first frame's depth.
Loop saccade(double pan) {
  const auto spec = rig_from_specs(
      {"sim:gaze-sway,mount=shoulder,gimbal=yes,lens=80,width=320,height=240,seed=1"});
  auto rig = open_rig(*spec, std::nullopt, sim_source_kinds());
  EXPECT_TRUE(rig) << rig.error().message();
  const SensorInfo& sensor = *(*rig)->sensors().front().source->sensor();
  const auto gimbal = (*rig)->gimbal_of(sensor.name);
  MonoStage mono(sensor, MonoSetup{}, gimbal->model());
  const Vector3d target(2 * std::sin(pan), 0, 2 * std::cos(pan));
  GazeConfig config;
  config.mode = "saccade";
  config.point_in_world = target;
  GazeStage gaze(config, gimbal->model(), *sensor.color_camera, up_in_world(MonoSetup{}),
                 (kDelay - 1) / sensor.rate);

  Loop loop;
  std::optional<Vector3d> true_target;
  std::deque<std::shared_ptr<const GimbalCommand>> commands(kDelay);
  for (int i = 0; i < kFrames; ++i) {
    if (commands.front()) {
      EXPECT_TRUE(gimbal->command(*commands.front()));
    }
    commands.pop_front();
    const auto frame = (*rig)->next();
    if (!frame || !*frame) break;
    const Pose& truth = (*frame)->truth->world_from_camera;
    if (!true_target) true_target = truth * target;
    const Vector3d in_camera = truth.inverse() * *true_target;
    loop.off.push_back(std::atan2(in_camera.head<2>().norm(), in_camera.z()));
    const auto state = gimbal->state_at((*frame)->time);
    const MonoStageOutput seen = mono.process({*frame, nullptr, state});
    loop.lost += seen.tracked->state == TrackingState::lost;
    GazeOutput out;
    if (i >= kStart) out = gaze.process({{seen.tracked, nullptr}, state});
    commands.push_back(out.command);
    loop.events.insert(loop.events.end(), out.events.begin(), out.events.end());
  }
  return loop;
}

TEST(MonoGaze, LeapsBeyondTheImageAndHoldsThePlaceWhileItsWearerSways) {
  const Loop loop = saccade(80 * kDegree);  // the image ends at 40
  ASSERT_EQ(loop.off.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(loop.lost, 0);
  // 0.5 s from the first command on.
  std::size_t arrived = kStart + kDelay;
  while (arrived < loop.off.size() && loop.off[arrived] > 1 * kDegree) ++arrived;
  const double seconds = static_cast<double>(arrived - kStart - kDelay) / 30;
  EXPECT_LE(seconds, 0.5);
  double squares = 0;
  const std::size_t settled = kStart + kDelay + 15;
  for (std::size_t i = settled; i < loop.off.size(); ++i) squares += loop.off[i] * loop.off[i];
  const double rms = std::sqrt(squares / static_cast<double>(loop.off.size() - settled));
  EXPECT_LT(rms, 0.5 * kDegree);
  RecordProperty("arrival_s", std::to_string(seconds));
  RecordProperty("rms_deg", std::to_string(rms / kDegree));
  ASSERT_EQ(loop.events.size(), 2U);
  EXPECT_EQ(std::get<GazeEvent>(loop.events[0].body).mode, GazeMode::saccade);
  EXPECT_EQ(std::get<GazeEvent>(loop.events[1].body).mode, GazeMode::fixate);
}

}  // namespace
}  // namespace armsreach::app
