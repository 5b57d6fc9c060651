#include "vision/mapping/update_block.hpp"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/unit/vision/mapping/shapes.hpp"
#include "vision/mapping/depth_band.hpp"
#include "vision/mapping/frame_evidence.hpp"

namespace armsreach::mapping {

// The build for the plainest processor; `update_block` is the one for this processor.
namespace baseline {
std::uint64_t cubes_in_reach(const float (&origin)[3], const FrameEvidence& frame);
std::uint64_t update_cubes(const Block& block, const float (&origin)[3], std::uint64_t cubes,
                           const FrameEvidence& frame, BlockCubes& updated);
}  // namespace baseline

namespace {

TEST(UpdateBlock, EveryProcessorLevelGivesTheSameBits) {
  const Camera camera = test::small_camera();
  cv::Mat depth =
      test::depth_of(test::nearest_of({test::plane(Eigen::Vector3d(0.4, -0.3, 1).normalized(), 1.3),
                                       test::sphere({0.1, 0, 1.1}, 0.2)}),
                     camera, Pose());
  cv::Mat intensity(depth.size(), CV_32FC1);
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) {
      intensity.at<float>(v, u) = static_cast<float>((u * 37 + v * 91) % 101) / 101;
    }
  }
  const VoxelMapOptions options;
  const HitTable hits(options.sensor);
  const DepthPlanes planes = depth_planes(depth, cv::Mat(), 0, camera, 8, options.resolution);
  const Pose camera_from_world =
      Pose::exp((Vector6d() << 0.01, 0.02, 0, 0.1, -0.2, 0.05).finished());
  FrameEvidence frame = frame_evidence(options, hits, planes, intensity, camera, camera_from_world);
  const DepthBand band(planes, camera, options.sensor, options.resolution);

  int changed = 0;
  for (const bool carve : {false, true}) {
    const DepthBand::Reach reach = band.reach(carve);
    band.aim(frame, reach, carve);
    for (int i = 0; i < 200; ++i) {
      Block stored;
      for (int at = 0; at < kBlockVoxels; at += 3) {
        stored.weight(at) = static_cast<std::uint16_t>(at * i % 5000);
        stored.distance(at) = static_cast<std::int16_t>(at * 13 % 2000 - 1000);
        stored.log_odds(at) = static_cast<std::int16_t>(at * 7 % 3000 - 1500);
      }
      const float origin[3] = {static_cast<float>(8 * (i % 10) - 40),
                               static_cast<float>(8 * (i / 10 % 4) - 16),
                               static_cast<float>(80 + 12 * (i / 40))};
      constexpr std::uint64_t kEverything = ~std::uint64_t{0};
      BlockCubes fast{};
      BlockCubes plain{};
      const std::uint64_t cubes = update_cubes(stored, origin, kEverything, frame, fast);
      EXPECT_EQ(cubes, baseline::update_cubes(stored, origin, kEverything, frame, plain)) << i;
      EXPECT_EQ(std::memcmp(fast, plain, sizeof(fast)), 0) << i;
      const std::uint64_t reached = cubes_in_reach(origin, frame);
      EXPECT_EQ(reached, baseline::cubes_in_reach(origin, frame)) << i;
      EXPECT_EQ(cubes & ~reached, 0U) << "what is not looked at would not change";
      changed += cubes != 0;
    }
  }
  EXPECT_GT(changed, 100);
}

}  // namespace
}  // namespace armsreach::mapping
