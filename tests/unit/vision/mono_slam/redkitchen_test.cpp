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
    EXPECT_LT(errors.ate_rmse, 0.012);
    EXPECT_GT(errors.alignment.scale, 0.9);
    EXPECT_LT(errors.alignment.scale, 1.1);
  }
}

TEST(RedKitchen, AllOfIt) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "rgbd/redkitchen");
  const test::MonoRecording kitchen = test::read_rgbd(folder, 200);
  // What is called truth jumps by 3.6 cm between two of these frames, and a tracker that uses all
  // depth departs from it by 1.7 cm.
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    EXPECT_LT(errors_of(kitchen, seed).ate_rmse, 0.03);
  }
}

// Kinects read their colour picture line by line in 20 to 30 ms, which nobody tells the filter.
TEST(RedKitchen, TheShuttersReadoutIsFound) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "rgbd/redkitchen");
  const test::MonoRecording kitchen = test::read_rgbd(folder, 121);
  MonoSlam slam(kitchen.camera, MonoSlamOptions());
  for (std::size_t i = 0; i < kitchen.frames.size(); ++i) {
    MonoInput input;
    input.time = kitchen.time(i);
    input.grey = kitchen.frames[i];
    if (i == 0) input.depth = kitchen.first_depth;
    slam.step(input);
  }
  EXPECT_GT(slam.filter().camera_state().readout, 0.012);
  EXPECT_LT(slam.filter().camera_state().readout, 0.033);
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
