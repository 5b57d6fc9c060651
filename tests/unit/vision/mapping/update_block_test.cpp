#include "vision/mapping/update_block.hpp"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/unit/vision/mapping/shapes.hpp"
#include "vision/mapping/frame_evidence.hpp"

namespace armsreach::mapping {

// The build for the plainest processor; `update_block` is the one for this processor.
namespace baseline {
bool update_block(Block& block, const float (&origin)[3], const DepthIntervals& depths,
                  const FrameEvidence& frame);
}

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
  DepthIntervals everything;
  for (DepthInterval& octant : everything.octant) octant = {0, 1e9F};

  int changed = 0;
  for (const bool carve : {false, true}) {
    frame.carve = carve;
    for (int i = 0; i < 200; ++i) {
      Block ours;
      for (int at = 0; at < kBlockVoxels; at += 3) {
        ours.weight(at) = static_cast<std::uint16_t>(at * i % 5000);
        ours.distance(at) = static_cast<std::int16_t>(at * 13 % 2000 - 1000);
        ours.log_odds(at) = static_cast<std::int16_t>(at * 7 % 3000 - 1500);
      }
      Block plain = ours;
      const float origin[3] = {static_cast<float>(8 * (i % 10) - 40),
                               static_cast<float>(8 * (i / 10 % 4) - 16),
                               static_cast<float>(80 + 12 * (i / 40))};
      const bool one = update_block(ours, origin, everything, frame);
      const bool other = baseline::update_block(plain, origin, everything, frame);
      EXPECT_EQ(one, other);
      EXPECT_EQ(std::memcmp(ours.cubes, plain.cubes, sizeof(ours.cubes)), 0) << i;
      EXPECT_EQ(ours.occupied, plain.occupied);
      changed += one;
    }
  }
  EXPECT_GT(changed, 100);
}

}  // namespace
}  // namespace armsreach::mapping
