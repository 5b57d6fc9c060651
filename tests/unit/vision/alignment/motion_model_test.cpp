#include "vision/alignment/motion_model.hpp"

#include <gtest/gtest.h>

namespace armsreach {
namespace {

constexpr Timestamp kInterval = 33'333'333;

Pose along_x(double metres) {
  return Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(metres, 0, 0));
}

MotionModel moving(double metres_per_frame) {
  MotionModel model({.velocity_kept = 0.9});
  model.start(Pose(), 0);
  model.update(along_x(metres_per_frame), kInterval);
  return model;
}

TEST(MotionModel, PredictsTheLastMotionDecayed) {
  const MotionModel model = moving(0.01);
  EXPECT_NEAR(model.predicted(2 * kInterval).translation().x(), 0.01 + 0.9 * 0.01, 1e-6);
}

TEST(MotionModel, KnowsTimeNotFrames) {
  const MotionModel model = moving(0.01);
  // Three intervals on at a speed that has decayed three times.
  EXPECT_NEAR(model.predicted(4 * kInterval).translation().x(), 0.01 + 0.729 * 0.03, 1e-6);
  // A clock that stands still or runs back counts as one interval.
  EXPECT_NEAR(model.predicted(0).translation().x(), 0.019, 1e-6);
}

TEST(MotionModel, ComesToRestWithoutMeasurements) {
  MotionModel model = moving(0.01);
  for (int i = 2; i < 300; ++i) model.coast(i * kInterval);
  const Pose at_rest = model.predicted(300 * kInterval);
  // The whole of a geometric series with 0.9 beyond the last measurement, and no further.
  EXPECT_NEAR(at_rest.translation().x(), 0.01 + 0.01 * 0.9 / (1 - 0.9), 1e-4);
  EXPECT_NEAR(model.measured().translation().x(), 0.01, 1e-12);
}

TEST(MotionModel, DoubtsJumpsAndGrowsLenientWithTime) {
  MotionModel model = moving(0);
  EXPECT_TRUE(model.plausible(along_x(0.09), 2 * kInterval));
  EXPECT_FALSE(model.plausible(along_x(0.5), 2 * kInterval));
  EXPECT_FALSE(model.plausible(Pose(so3_exp({0, 1, 0}), Eigen::Vector3d::Zero()), 2 * kInterval));
  for (int i = 2; i < 12; ++i) model.coast(i * kInterval);
  EXPECT_TRUE(model.plausible(along_x(0.5), 12 * kInterval));
}

}  // namespace
}  // namespace armsreach
