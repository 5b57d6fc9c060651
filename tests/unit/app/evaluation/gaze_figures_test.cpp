#include "app/evaluation/gaze_figures.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace armsreach::app {
namespace {

constexpr double kDegree = M_PI / 180;

// The target stands at `target(t)` to the right of the mount's axis, the camera looks `axis(t)` to
// the right; rad.
GazeRun run_of(const std::function<double(double)>& target,
               const std::function<double(double)>& axis, double seconds) {
  GazeRun run;
  run.half_width = 40 * kDegree;
  for (int i = 0; i < 30 * seconds; ++i) {
    GazeSample sample;
    sample.time = i / 30.0;
    sample.saccade = 0;
    const double off = target(sample.time) - axis(sample.time);
    sample.off = std::abs(off);
    sample.bearing = {off, 0};
    sample.central = std::abs(off) < 20 * kDegree;
    sample.angles = {axis(sample.time), 0, 0};
    sample.direction = {std::sin(target(sample.time)), 0, std::cos(target(sample.time))};
    sample.target_in_world = 0.5 * sample.direction;
    run.samples.push_back(sample);
  }
  return run;
}

double step_at_2(double time) { return time < 2 ? 0 : 15 * kDegree; }

TEST(GazeFigures, ASwingingAxisIsFoundOut) {
  // Decays round the target's place at 2 Hz.
  const auto swinging = [](double t) {
    const double since = t - 2;
    return since < 0 ? 0 : 15 * kDegree * (1 - std::exp(-since) * std::cos(4 * M_PI * since));
  };
  const StepFigures figures = step_figures(run_of(step_at_2, swinging, 6));
  EXPECT_EQ(figures.steps, 1);
  EXPECT_NEAR(figures.size, 15 * kDegree, 1e-9);
  // 15 degrees * exp(-0.25) after half a period; it stays above 0.5 degrees for 3.4 s, 4 crossings
  // a second.
  EXPECT_NEAR(figures.overshoot, 15 * kDegree * std::exp(-0.25), 0.2 * kDegree);
  EXPECT_GE(figures.crossings, 10);
  EXPECT_GT(figures.settled, 2);
}

TEST(GazeFigures, AQuietOneHasNeitherOvershootNorCrossings) {
  const auto calm = [](double t) {
    return t < 2 ? 0 : 15 * kDegree * (1 - std::exp(-10 * (t - 2)));
  };
  const StepFigures figures = step_figures(run_of(step_at_2, calm, 6));
  EXPECT_EQ(figures.overshoot, 0);
  EXPECT_EQ(figures.crossings, 0);
  EXPECT_NEAR(figures.settled, 0.1 * std::log(15), 1.5 / 30);  // a degree is left; whole frames
}

TEST(GazeFigures, HoldingIsMeasuredAfterTheFirstSecond) {
  const auto off = [](double t) { return t < 1 ? 1.0 : t < 2 ? 30 * kDegree : 10 * kDegree; };
  const HoldFigures figures = hold_figures(run_of([](double) { return 0; }, off, 3));
  EXPECT_NEAR(figures.central, 0.5, 0.02);
  EXPECT_NEAR(figures.rms, std::sqrt(0.5 * (900 + 100)) * kDegree, 0.01);
  EXPECT_NEAR(figures.largest, 30 * kDegree, 1e-9);
}

TEST(GazeFigures, ASaccadeThatSlipsAwayAgainHasNotArrived) {
  const auto target = [](double) { return 75 * kDegree; };
  const auto slips = [](double t) { return (t < 0.3 ? 0 : t < 0.8 ? 75 : 60) * kDegree; };
  const auto stays = [](double t) { return (t < 0.3 ? 0 : 75) * kDegree; };
  const auto away = saccade_figures(run_of(target, slips, 1.2));
  ASSERT_EQ(away.size(), 1U);
  EXPECT_FALSE(away[0].arrived);
  EXPECT_NEAR(away[0].beyond_edge, 35 * kDegree, 1e-9);
  const auto there = saccade_figures(run_of(target, stays, 1.2));
  EXPECT_NEAR(there[0].arrived.value(), 0.3, 1e-9);
}

}  // namespace
}  // namespace armsreach::app
