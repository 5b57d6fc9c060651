// A hand-held Kinect's colour camera alone; the depth of the first frame gives the scale.
#include <gtest/gtest.h>

#include "tests/support/recordings.hpp"
#include "tests/unit/vision/mono_slam/mono_recording.hpp"

namespace armsreach::mono_slam {
namespace {

TrajectoryErrors errors_of(const test::MonoRecording& kitchen, std::uint64_t seed) {
  MonoSlamOptions options;
  options.seed = seed;
  const test::Summary summary = test::run(kitchen, options);
  EXPECT_EQ(summary.lost, 0);
  EXPECT_EQ(summary.results.back().scale, ScaleFrom::depth);
  return *trajectory_errors(summary.estimate, kitchen.truth, true);
}

TEST(RedKitchen, ThePathIsRightAndToScale) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "rgbd/redkitchen");
  const test::MonoRecording kitchen = test::read_rgbd(folder, 121);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TrajectoryErrors errors = errors_of(kitchen, seed);
    EXPECT_EQ(errors.pairs, 121);
    EXPECT_LT(errors.ate_rmse, 0.015);
    EXPECT_GT(errors.alignment.scale, 0.9);
    EXPECT_LT(errors.alignment.scale, 1.1);
  }
}

TEST(RedKitchen, AllOfIt) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "rgbd/redkitchen");
  const test::MonoRecording kitchen = test::read_rgbd(folder, 200);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    EXPECT_LT(errors_of(kitchen, seed).ate_rmse, 0.03);
  }
}

TEST(RedKitchen, DepthIsUsedForNothingAfterTheFirstFrame) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "rgbd/redkitchen");
  const test::MonoRecording kitchen = test::read_rgbd(folder, 60);
  const test::Summary without = test::run(kitchen, MonoSlamOptions());
  const test::Summary with =
      test::run(kitchen, MonoSlamOptions(), [&](std::size_t, MonoInput* input) {
        // Wrong by half: would be noticed.
        if (input->depth.empty()) input->depth = 0.5 * kitchen.first_depth;
        return true;
      });
  EXPECT_EQ(without.estimate.back().world_from_camera.matrix(),
            with.estimate.back().world_from_camera.matrix());
}

}  // namespace
}  // namespace armsreach::mono_slam
