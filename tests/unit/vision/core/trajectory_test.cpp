#include "vision/core/trajectory.hpp"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

Trajectory circle(int poses) {
  Trajectory trajectory;
  for (int i = 0; i < poses; ++i) {
    const double angle = 0.05 * i;
    Vector6d tangent;
    tangent << std::cos(angle), std::sin(angle), 0.1 * angle, 0, 0, angle;
    trajectory.push_back({timestamp_from_seconds(i / 30.0), Pose::exp(tangent)});
  }
  return trajectory;
}

Trajectory moved(const Trajectory& trajectory, const Pose& by, double scale) {
  Trajectory out;
  for (const TimedPose& p : trajectory) {
    const Pose pose = by * p.world_from_camera;
    out.push_back({p.time, Pose(pose.rotation(), scale * pose.translation())});
  }
  return out;
}

TEST(Trajectory, ErrorsIgnoreTheFrameOfReference) {
  const Trajectory truth = circle(60);
  const Pose by = Pose::exp((Vector6d() << 3, -1, 2, 0.4, 0.8, -1).finished());
  const auto errors = trajectory_errors(moved(truth, by, 1), truth, false);
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->pairs, 60);
  EXPECT_EQ(errors->coverage, 1);
  EXPECT_LT(errors->ate_rmse, 1e-9);
  EXPECT_LT(errors->rpe_frame_translation, 1e-9);
  EXPECT_LT(errors->rpe_second_rotation, 1e-9);
}

TEST(Trajectory, ScaleIsFoundOnlyWhenAsked) {
  const Trajectory truth = circle(60);
  const auto with = trajectory_errors(moved(truth, Pose(), 2), truth, true);
  const auto without = trajectory_errors(moved(truth, Pose(), 2), truth, false);
  EXPECT_NEAR(with->alignment.scale, 0.5, 1e-9);
  EXPECT_LT(with->ate_rmse, 1e-9);
  EXPECT_GT(without->ate_rmse, 0.1);
}

TEST(Trajectory, AKnownErrorIsMeasured) {
  Trajectory estimate = circle(61);
  const Trajectory truth = estimate;
  // Every second pose 2 cm up, the others 2 cm down: rms 2 cm about the mean.
  for (size_t i = 0; i < estimate.size(); ++i) {
    Pose& pose = estimate[i].world_from_camera;
    pose = Pose(pose.rotation(), pose.translation() + Eigen::Vector3d(0, 0, i % 2 ? 0.02 : -0.02));
  }
  const auto errors = trajectory_errors(estimate, truth, false);
  EXPECT_NEAR(errors->ate_rmse, 0.02, 1e-3);
  EXPECT_NEAR(errors->rpe_frame_translation, 0.04, 1e-6);
}

TEST(Trajectory, TextRoundTripAndBadLines) {
  std::stringstream text;
  for (const TimedPose& pose : circle(5)) write_tum_pose(text, pose);
  const auto read = read_tum_trajectory(text, "t.txt");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->size(), 5U);

  for (const char* line : {"0 1 2 3 0 0 0", "a b c", "0 nan 0 0 0 0 0 1", "0 0 0 0 0 0 0 0",
                           "1e300 0 0 0 0 0 0 1", "-1e10 0 0 0 0 0 0 1"}) {
    std::istringstream bad(std::string("# comment\n") + line + "\n");
    const auto result = read_tum_trajectory(bad, "t.txt");
    ASSERT_FALSE(result) << line;
    EXPECT_EQ(result.error().where, "t.txt:2");
  }
  std::istringstream backwards("1 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n");
  EXPECT_FALSE(read_tum_trajectory(backwards, "t.txt"));
}

}  // namespace
}  // namespace armsreach
