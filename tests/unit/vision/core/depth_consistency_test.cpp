#include "vision/core/depth_consistency.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

TEST(DepthConsistency, MeasuresAKnownErrorOfThePose) {
  const Camera camera = pinhole(64, 48, 60, 60, 32, 24);
  const cv::Mat wall(48, 64, CV_32F, cv::Scalar(2.0));
  std::vector<float> differences;
  add_depth_differences(wall, wall, camera, Pose(), 4, &differences);
  EXPECT_EQ(differences.size(), 16U * 12U);
  EXPECT_NEAR(median(&differences), 0, 1e-7);

  // 2 cm nearer, so each point is expected at 1.98 m: |dz| / z^2 = 0.02 / 1.98^2.
  differences.clear();
  const Pose nearer(Eigen::Quaterniond::Identity(), {0, 0, -0.02});
  add_depth_differences(wall, wall, camera, nearer, 4, &differences);
  EXPECT_NEAR(median(&differences), 0.02 / (1.98 * 1.98), 1e-5);
}

TEST(DepthConsistency, OtherSurfacesAndHolesAreNoErrors) {
  const Camera camera = pinhole(64, 48, 60, 60, 32, 24);
  const cv::Mat wall(48, 64, CV_32F, cv::Scalar(2.0));
  const cv::Mat thing(48, 64, CV_32F, cv::Scalar(1.0));
  const cv::Mat hole(48, 64, CV_32F, cv::Scalar(std::nan("")));
  std::vector<float> differences;
  add_depth_differences(wall, thing, camera, Pose(), 4, &differences);
  add_depth_differences(wall, hole, camera, Pose(), 4, &differences);
  add_depth_differences(hole, wall, camera, Pose(), 4, &differences);
  EXPECT_TRUE(differences.empty());
  EXPECT_TRUE(std::isnan(median(&differences)));
}

}  // namespace
}  // namespace armsreach
