#include "devices/sim/sim_gimbal.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "devices/open.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/sim/worlds.hpp"
#include "devices/truth.hpp"

namespace armsreach::sim {
namespace {

constexpr double kDegree = M_PI / 180;

GimbalModel model() {
  GimbalModel made;
  made.lower = {-1, -0.5, -0.3};
  made.upper = {1, 0.5, 0.3};
  made.fastest = {3, 2, 1};
  made.acceleration = {20, 30, 40};
  made.lag = 0.03;
  return made;
}

Timestamp ms(double milliseconds) { return timestamp_from_seconds(1e-3 * milliseconds); }

TEST(SimGimbal, KeepsItsLimitsOfAngleSpeedAndAcceleration) {
  SimGimbal gimbal("main", model(), {});
  ASSERT_TRUE(gimbal.command({0, {5, -5, 5}}).ok());
  GimbalState before = gimbal.advance(0);
  Eigen::Vector3d fastest = Eigen::Vector3d::Zero();
  for (int i = 1; i <= 1500; ++i) {
    if (i == 400) {
      ASSERT_TRUE(gimbal.command({ms(i), {-5, 5, -5}}).ok());
    }
    const GimbalState now = gimbal.advance(ms(i));
    EXPECT_TRUE((now.angles.array() >= model().lower.array()).all());
    EXPECT_TRUE((now.angles.array() <= model().upper.array()).all());
    // At the limit's stop the axis is held, whatever its speed was.
    const Eigen::Array3d change = (now.rates - before.rates).array().abs() / 1e-3;
    for (int axis = 0; axis < 3; ++axis) {
      const bool at_stop =
          now.angles[axis] == model().lower[axis] || now.angles[axis] == model().upper[axis];
      if (!at_stop) {
        EXPECT_LE(change[axis], model().acceleration[axis] * (1 + 1e-6));
      }
    }
    fastest = fastest.cwiseMax(now.rates.cwiseAbs());
    before = now;
  }
  EXPECT_TRUE((fastest.array() <= model().fastest.array() * (1 + 1e-9)).all());
  EXPECT_NEAR(fastest[0], model().fastest[0], 1e-9) << "2 rad are far enough for full speed";
  EXPECT_LT((before.angles - model().lower.cwiseProduct(Eigen::Vector3d(1, -1, 1))).norm(), 1e-6);
}

// Without reaching full speed half the way is accelerated and half braked: t = 2 sqrt(way / a).
TEST(SimGimbal, TakesTheTimeThatItsAccelerationAllows) {
  SimGimbal gimbal("main", model(), {});
  ASSERT_TRUE(gimbal.command({ms(10), {0.2, 0, 0}}).ok());
  int started = 0;
  int arrived = 0;
  for (int i = 1; i < 1000; ++i) {
    const double pan = gimbal.advance(ms(i)).angles[0];
    if (started == 0 && pan > 1e-9) started = i;
    if (arrived == 0 && pan > 0.2 - 1e-4) arrived = i;
    EXPECT_LT(pan, 0.2 + 1e-6) << "it does not overshoot";
  }
  EXPECT_NEAR(started, 10 + 30, 2);  // the command's time and the lag
  EXPECT_NEAR(arrived - started, 1e3 * 2 * std::sqrt(0.2 / 20), 8);
}

TEST(SimGimbal, IsTheSameHoweverOftenItIsAsked) {
  SimGimbal often("main", model(), {});
  SimGimbal seldom("main", model(), {});
  for (SimGimbal* gimbal : {&often, &seldom})
    ASSERT_TRUE(gimbal->command({ms(100), {0.7, -0.3, 0.1}}).ok());
  for (int i = 0; i < 300; ++i) often.advance(ms(i));
  EXPECT_EQ(often.advance(ms(300)).angles, seldom.advance(ms(300)).angles);
}

TEST(SimGimbal, RemembersWhereItWasAndWhatItWasTold) {
  SimGimbal gimbal("main", model(), {{ms(50), {0.1, 0, 0}}});
  for (int i = 0; i <= 30; ++i) gimbal.advance(ms(33 * i));
  const auto between = gimbal.state_at(ms(100));
  ASSERT_TRUE(between.has_value());
  EXPECT_GT(between->angles[0], gimbal.state_at(ms(99))->angles[0]);
  EXPECT_FALSE(gimbal.state_at(ms(2000)).has_value());
  const auto commands = gimbal.take_commands();
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].time, ms(50));
  EXPECT_TRUE(gimbal.take_commands().empty());
}

TEST(SimGimbal, WhatIsNotFiniteIsRefused) {
  SimGimbal gimbal("main", model(), {});
  EXPECT_FALSE(gimbal.command({0, {std::nan(""), 0, 0}}).ok());
}

TEST(GimbalModel, AxesTurnTheCameraAsTheirNamesSay) {
  const GimbalModel made;
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ();
  const auto looks = [&](const Eigen::Vector3d& angles) -> Eigen::Vector3d {
    return mount_from_camera(made, angles).rotation() * ahead;
  };
  EXPECT_GT(looks({0.1, 0, 0}).x(), 0.09);   // to the right
  EXPECT_LT(looks({0, 0.1, 0}).y(), -0.09);  // up, y being down
  const Eigen::Vector3d right =
      mount_from_camera(made, {0, 0, 0.1}).rotation() * Eigen::Vector3d::UnitX();
  EXPECT_GT(right.y(), 0.09);  // clockwise: the right side goes down
}

TEST(GimbalModel, OffsetsFollowTheAxesBeforeThem) {
  GimbalModel made;
  made.offsets = {Eigen::Vector3d(0, -0.05, 0), {0, 0, 0.02}, {0, 0, 0.03}};
  const Pose right = mount_from_camera(made, {90 * kDegree, 0, 0});
  EXPECT_LT((right.translation() - Eigen::Vector3d(0.05, -0.05, 0)).norm(), 1e-12);
}

// Its commands move the camera, as much as its states say.
TEST(SimGimbal, MovesTheCameraOfItsSource) {
  const std::string spec = "sim:packaging,mount=shoulder,gimbal=yes,width=32,noise=none,frames=30";
  auto still = *open_source(*parse_source_spec(spec), {}, sim_source_kinds());
  auto moved = *open_source(*parse_source_spec(spec), {}, sim_source_kinds());
  ASSERT_EQ(moved->actuators().size(), 1U);
  const auto gimbal = std::dynamic_pointer_cast<Gimbal>(moved->actuators()[0]);
  ASSERT_TRUE(gimbal);
  EXPECT_EQ(gimbal->name(), "main");
  ASSERT_TRUE(gimbal->command({ms(200), {0.4, -0.2, 0.1}}).ok());
  Eigen::Vector3d final_angles;
  for (int i = 0; i < 30; ++i) {
    const FramePtr a = *still->next();
    const FramePtr b = *moved->next();
    const GimbalState state = *gimbal->state_at(b->time);
    ASSERT_TRUE(b->truth->gimbal.has_value());
    EXPECT_EQ(state.angles, b->truth->gimbal->angles);
    const Pose turned = a->world_from_camera->inverse() * *b->world_from_camera;
    const Pose expected = mount_from_camera(gimbal->model(), state.angles);
    // States come at whole nanoseconds, in which 5 rad/s turn by 5e-9.
    EXPECT_LT((turned.inverse() * expected).log().norm(), 1e-8);
    final_angles = state.angles;
  }
  EXPECT_LT((final_angles - Eigen::Vector3d(0.4, -0.2, 0.1)).norm(), 1e-3);
}

}  // namespace
}  // namespace armsreach::sim
