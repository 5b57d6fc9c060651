#include "vision/gaze/gaze_controller.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "tests/unit/vision/gaze/closed_loop.hpp"

namespace armsreach {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180;

// The world's z is up; the mount looks along the world's y.
Pose upright_mount(const Vector3d& position = Vector3d::Zero()) {
  Eigen::Matrix3d world_from_mount;
  world_from_mount << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return {Eigen::Quaterniond(world_from_mount), position};
}

Loop standing_loop() {
  Loop loop;
  loop.world_from_mount = [](double) { return upright_mount(); };
  return loop;
}

// To and fro, at up to 0.5 m/s, 0.5 m away: up to 1 rad/s.
Vector3d waving_hand(double time) {
  return {0.2 * std::sin(2.5 * time), 0.5, -0.08 * std::sin(1.3 * time)};
}

// After a step at time 1 s the target is 15 degrees to the right.
Vector3d stepping_target(double time) {
  return time < 1 ? Vector3d(0, 0.5, 0)
                  : Vector3d(0.5 * std::sin(15 * kDegree), 0.5 * std::cos(15 * kDegree), 0);
}

// How often the bearing changes its side by more than 0.5 degrees.
int crossings(const std::vector<LoopSample>& samples, double from) {
  int side = 0;
  int count = 0;
  for (const LoopSample& sample : samples) {
    const double bearing = sample.bearing.x();
    if (sample.time < from || std::abs(bearing) < 0.5 * kDegree) continue;
    const int now = bearing > 0 ? 1 : -1;
    count += side != 0 && now != side;
    side = now;
  }
  return count;
}

// Turns by a share of the error that it sees, from where the gimbal is: what one writes first.
Commander proportional(const Loop& loop, double gain) {
  return [&loop, gain, last = GimbalCommand{}](const GazeInput& input) mutable {
    last.time = input.now;
    if (!input.target) return last;
    const Vector3d ray = unproject(loop.camera, input.target->pixel);
    last.angles = input.gimbal->angles;
    last.angles[0] += gain * std::atan(ray.x());
    last.angles[1] -= gain * std::atan(ray.y());
    return last;
  };
}

// The design's figure for following: the central half of the image is within a quarter of its
// width and height of the centre.
TEST(GazeController, KeepsAWavingHandInTheCentralHalfWithAHundredMillisecondsOfDelay) {
  Loop loop = standing_loop();
  loop.target_in_world = waving_hand;
  loop.seconds = 12;
  GazeController controller(loop.model, loop.camera);
  controller.follow("hand");
  double farthest = 0;
  for (const LoopSample& sample : run(loop, controller)) {
    if (sample.time > 1) farthest = std::max(farthest, sample.bearing.cwiseAbs().maxCoeff());
  }
  // The half ends at atan(120 / 381) = 17.5 degrees up and down. Standing still through delay, lag
  // and a frame would be 1 rad/s * 0.17 s = 10 degrees off; predicted it is a quarter of that.
  EXPECT_LT(farthest, 3 * kDegree);
}

TEST(GazeController, DoesNotSwingAfterAStepWhereAProportionalOneDoes) {
  Loop loop = standing_loop();
  loop.target_in_world = stepping_target;
  GazeController controller(loop.model, loop.camera);
  controller.follow();
  const auto samples = run(loop, controller);
  double overshoot = 0;
  for (const LoopSample& sample : samples) {
    if (sample.time > 1.05) overshoot = std::max(overshoot, -sample.bearing.x());
  }
  EXPECT_LT(overshoot, 0.5 * kDegree);
  EXPECT_EQ(crossings(samples, 1), 0);
  // Delay, two measurements that agree, lag and 0.13 s of way make 0.32 s.
  EXPECT_LT(rms_off(samples, 1.4, 6), 0.2 * kDegree);

  const auto swinging = run(loop, proportional(loop, 0.6));
  EXPECT_GT(crossings(swinging, 1), 4) << "the test would not see a loop that swings";
}

// A blob's place is uncertain by pixels: 3 of them are 0.45 degrees here.
TEST(GazeController, StaysCalmWhereTheTargetIsSeenWithNoise) {
  Loop loop = standing_loop();
  loop.target_in_world = [](double) { return Vector3d(0.05, 0.5, 0); };
  GazeController controller(loop.model, loop.camera);
  controller.follow();
  std::mt19937 random(1);
  std::normal_distribution<double> pixels(0, 3);
  const auto samples = run(loop, [&](GazeInput input) {
    if (input.target) input.target->pixel += Eigen::Vector2d(pixels(random), pixels(random));
    return controller.step(input);
  });
  EXPECT_LT(rms_off(samples, 1, 6), 1.2 * kDegree);
}

TEST(GazeController, HoldsWhenTheTargetIsNoLongerSeen) {
  Loop loop = standing_loop();
  loop.target_in_world = [](double t) {
    return t < 2 ? waving_hand(t) : Vector3d(0, -1, 0);  // then behind the wearer
  };
  GazeController controller(loop.model, loop.camera);
  controller.follow();
  const auto samples = run(loop, controller);
  const Vector3d held = samples.at(100).angles;  // 1.3 s later
  EXPECT_LT((samples.back().angles - held).norm(), 1e-6);
  EXPECT_LT(std::abs(held[0]), 0.9) << "it does not run off with the last speed";
}

// 40 degrees beyond the edge of an image of 80: 80 degrees to the right. Poses have come before.
TEST(GazeController, ASaccadeBeyondTheImageArrivesWithinHalfASecond) {
  Loop loop = standing_loop();
  const Vector3d point(std::sin(80 * kDegree), std::cos(80 * kDegree), -0.2);
  loop.target_in_world = [&](double) { return point; };
  GazeController controller(loop.model, loop.camera);
  constexpr double kBegin = 0.5;
  bool begun = false;
  const auto samples = run(loop, controller, [&](double time) {
    if (time >= kBegin && !std::exchange(begun, true)) controller.saccade_to_world(point, "shelf");
  });
  for (const LoopSample& sample : samples) {
    if (sample.time >= kBegin + 0.5) {
      EXPECT_LT(sample.off, 1 * kDegree) << sample.time;
    }
    if (sample.time >= kBegin + 0.6) {
      EXPECT_EQ(sample.mode, GazeMode::fixate);
    }
    if (sample.time > kBegin + 1) {
      EXPECT_NEAR(sample.torsion, 0, 0.1 * kDegree);
    }
  }
  const Events events = controller.take_events();
  ASSERT_EQ(events.size(), 2U);
  const auto& leap = std::get<GazeEvent>(events[0].body);
  EXPECT_EQ(leap.mode, GazeMode::saccade);
  EXPECT_EQ(leap.target, "shelf");
  EXPECT_NEAR(leap.angles[0], 80 * kDegree, 0.02);
  EXPECT_EQ(std::get<GazeEvent>(events[1].body).mode, GazeMode::fixate);
}

// The wearer sways at up to 0.2 m/s and turns with it; poses are as late as an image and a filter
// make them.
TEST(GazeController, FixatesWhileTheWearerSways) {
  Loop loop;
  loop.seconds = 12;
  loop.delay = 0.067;
  loop.world_from_mount = [](double t) {
    const double along = 0.08 * std::sin(2.5 * t);
    return upright_mount({along, 0.3 * along, 0.01 * std::sin(5 * t)}) *
           Pose(so3_exp({0.02 * std::sin(2 * t), 0.6 * along, 0.03 * std::sin(3 * t)}),
                Vector3d::Zero());
  };
  const Vector3d point(0.2, 0.7, -0.3);
  loop.target_in_world = [&](double) { return point; };
  GazeController controller(loop.model, loop.camera);
  const auto samples = run(loop, controller, [&](double time) {
    if (time == 0) controller.saccade_to_world(point);
  });
  EXPECT_LT(rms_off(samples, 1.5, 12), 0.5 * kDegree);
  double torsion = 0;
  for (const LoopSample& sample : samples)
    if (sample.time > 1.5) torsion = std::max(torsion, std::abs(sample.torsion));
  EXPECT_LT(torsion, 1 * kDegree) << "the horizon stays level; the mount rolls by 1.7 degrees";

  // Told one pose and no more, it holds the mount's direction, and the point wanders.
  GazeController still(loop.model, loop.camera);
  still.saccade_to_world(point);
  const auto wandering = run(loop, [&, told = false](GazeInput input) mutable {
    if (input.pose && std::exchange(told, true)) input.pose.reset();
    return still.step(input);
  });
  EXPECT_GT(rms_off(wandering, 1.5, 12), 3 * kDegree);
}

TEST(GazeController, StabilisesTheDirectionInWhichItLooks) {
  Loop loop;
  loop.delay = 0.067;
  loop.world_from_mount = [](double t) {
    return upright_mount() * Pose(so3_exp({0, 0.15 * std::sin(2 * t), 0}), Vector3d::Zero());
  };
  loop.target_in_world = [](double) { return Vector3d(0, 3, 0); };  // in the middle at time 0
  GazeController controller(loop.model, loop.camera);
  const auto samples = run(loop, controller, [&](double time) {
    if (time == 0.2) controller.stabilise();
  });
  // It was at some place off the target when it was told to stay; from there it does not wander.
  double least = 1;
  double most = -1;
  for (const LoopSample& sample : samples) {
    if (sample.time < 1) continue;
    least = std::min(least, sample.bearing.x());
    most = std::max(most, sample.bearing.x());
  }
  EXPECT_LT(most - least, 1.5 * kDegree) << "the mount turns by 17 degrees";
}

TEST(GazeController, RestsStraightAheadAndSaysWhatIsOutOfReach) {
  Loop loop = standing_loop();
  loop.target_in_world = waving_hand;
  GazeController controller(loop.model, loop.camera);
  EXPECT_EQ(controller.step({}).angles, Vector3d::Zero());
  controller.saccade_to_world({0, 0, -1});
  GazeInput input;
  input.gimbal = GimbalState{};
  input.pose = CameraPoseSeen{};
  controller.step(input);
  EXPECT_FALSE(controller.reachable());
  controller.rest();
  EXPECT_EQ(controller.step({}).angles, Vector3d::Zero());
  EXPECT_TRUE(controller.reachable());
}

// Without a pose a point in the world is nowhere: it waits.
TEST(GazeController, APointInTheWorldWaitsForAPose) {
  GazeController controller(GimbalModel{}, Loop{}.camera);
  controller.saccade_to_world({1, 1, 1});
  GazeInput input;
  input.gimbal = GimbalState{};
  EXPECT_EQ(controller.step(input).angles, Vector3d::Zero());
  EXPECT_EQ(controller.mode(), GazeMode::saccade);
  input.pose = CameraPoseSeen{0, Pose()};
  EXPECT_GT(controller.step(input).angles[0], 0.5);
}

}  // namespace
}  // namespace armsreach
