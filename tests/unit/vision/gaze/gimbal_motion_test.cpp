#include "vision/core/gimbal_motion.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

Timestamp ms(double milliseconds) { return timestamp_from_seconds(1e-3 * milliseconds); }

TEST(GimbalMotion, NothingMovesBeforeTheLagHasPassed) {
  GimbalModel model;
  model.lag = 0.05;
  GimbalMotion motion(model);
  motion.command({ms(100), {0.5, 0, 0}});
  EXPECT_EQ(motion.advance(ms(150)).angles[0], 0);
  EXPECT_GT(motion.advance(ms(160)).angles[0], 0);
  EXPECT_NEAR(motion.advance(ms(1000)).angles[0], 0.5, 1e-9);
}

TEST(GimbalMotion, HaltingStaysNearWhereItIs) {
  GimbalMotion motion{GimbalModel{}};
  motion.command({0, {1.5, 0, 0}});
  const GimbalState moving = motion.advance(ms(200));
  motion.halt();
  const GimbalState still = motion.advance(ms(1000));
  EXPECT_EQ(still.rates[0], 0);
  EXPECT_NEAR(still.angles[0], moving.angles[0], 0.01)
      << "it overshoots while it brakes, and returns";
}

// What a filter is told is what the camera did.
TEST(GimbalMotion, CameraMotionIsBetweenTheTwoCameras) {
  GimbalModel model;
  model.offsets[2] = {0.01, 0.02, 0.05};
  const Eigen::Vector3d before(0.1, -0.2, 0.05);
  const Eigen::Vector3d after(0.4, 0.1, 0);
  const Eigen::Vector3d point_after(0.1, 0.2, 1);
  const Eigen::Vector3d through_mount =
      mount_from_camera(model, before).inverse() * (mount_from_camera(model, after) * point_after);
  EXPECT_LT((camera_motion(model, before, after) * point_after - through_mount).norm(), 1e-12);
}

}  // namespace
}  // namespace armsreach
