// The targets of the gaze in the simulator: its wearer, its hand, its gimbal, its camera.
#include "app/evaluation/gaze_trial.hpp"

#include <memory>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "app/evaluation/gaze_figures.hpp"
#include "devices/rig.hpp"
#include "devices/sim/sim_source.hpp"

namespace armsreach::app {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// The pictures are not looked at: small ones will do.
GazeRun run(const std::string& world, const GazeTrial& trial) {
  const auto spec = rig_from_specs(
      {"sim:" + world + ",mount=shoulder,gimbal=yes,lens=80,width=80,height=60,color=clean"});
  EXPECT_TRUE(spec) << spec.error().message();
  auto rig = open_rig(*spec, std::nullopt, sim_source_kinds());
  EXPECT_TRUE(rig) << rig.error().message();
  auto done = run_gaze_trial(**rig, trial);
  EXPECT_TRUE(done) << done.error().message();
  return done ? *done : GazeRun{};
}

TEST(GazeTrial, FollowsAHandWithAHundredMillisecondsOfDelayWithoutSwinging) {
  const GazeRun done = run("gaze", {.targets = {"hand"}});
  const HoldFigures hold = hold_figures(done);
  EXPECT_GE(hold.target_speed, 0.48) << "m/s: the hand is to move at half a metre a second";
  EXPECT_GE(hold.bearing_speed, 0.9) << "rad/s";
  EXPECT_EQ(hold.central, 1);
  const StepFigures steps = step_figures(done);
  EXPECT_EQ(steps.steps, 2);
  EXPECT_LT(steps.overshoot, 1 * kDegree) << "what the body's unrest makes of it";
  EXPECT_EQ(steps.crossings, 0);
  EXPECT_LT(steps.settled, 0.5);
}

TEST(GazeTrial, SaccadesArriveWithinHalfASecondAlsoFortyDegreesBeyondTheEdge) {
  const GazeRun done =
      run("gaze", {.mode = GazeMode::saccade, .targets = {"mug", "clock", "mug", "vase"}});
  double farthest = 0;
  for (const SaccadeFigures& one : saccade_figures(done)) {
    ASSERT_TRUE(one.arrived) << one.begins;
    EXPECT_LE(*one.arrived, 0.5) << one.begins;
    EXPECT_LT(one.error, 1 * kDegree) << one.begins;
    farthest = std::max(farthest, one.beyond_edge);
  }
  EXPECT_GE(farthest, 40 * kDegree);
}

TEST(GazeTrial, FixatesWhileTheWearerSways) {
  const HoldFigures hold =
      hold_figures(run("gaze-sway", {.mode = GazeMode::fixate, .targets = {"mug"}}));
  EXPECT_GE(hold.mount_speed, 0.2) << "m/s rms";
  EXPECT_LT(hold.rms, 0.5 * kDegree);
  EXPECT_LT(hold.torsion_rms, 1 * kDegree);
}

TEST(GazeTrial, SaysWhatItNeeds) {
  const auto still = rig_from_specs({"sim:bench,frames=2,width=80,height=60"});
  auto rig = open_rig(*still, std::nullopt, sim_source_kinds());
  ASSERT_TRUE(rig);
  const auto no_gimbal = run_gaze_trial(**rig, {.targets = {"mug"}});
  ASSERT_FALSE(no_gimbal);
  EXPECT_NE(no_gimbal.error().what.find("gimbal"), std::string::npos);

  const auto spec = rig_from_specs({"sim:gaze,gimbal=yes,frames=2,width=80,height=60"});
  rig = open_rig(*spec, std::nullopt, sim_source_kinds());
  ASSERT_TRUE(rig);
  const auto nobody = run_gaze_trial(**rig, {.targets = {"elephant"}});
  ASSERT_FALSE(nobody);
  EXPECT_NE(nobody.error().remedy.find("mug"), std::string::npos) << nobody.error().remedy;
}

}  // namespace
}  // namespace armsreach::app
