// Depth seen from another camera, checked against the geometry of a plane.
#include "vision/core/registration.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace armsreach {
namespace {

TEST(Registration, APlaneHasItsDepthInTheOtherCamera) {
  const Camera depth_camera = pinhole(160, 120, 146, 146, 80, 60);
  const Camera color_camera = pinhole(160, 120, 132, 132, 79, 61);
  const Pose color_from_depth = Pose::exp((Vector6d() << -0.025, 0, 0, 0, 0.02, 0.01).finished());
  // The plane n.p = 1.2 in the depth camera, tilted by 20 degrees.
  const Eigen::Vector3d normal(std::sin(0.35), 0, std::cos(0.35));
  cv::Mat depth(120, 160, CV_32F);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      depth.at<float>(y, x) =
          static_cast<float>(1.2 / normal.dot(unproject(depth_camera, Eigen::Vector2d(x, y))));
    }
  }
  const cv::Mat registered = registered_depth(depth, depth_camera, color_camera, color_from_depth);
  const Eigen::Vector3d normal_in_color = color_from_depth.rotation() * normal;
  const double offset = 1.2 + normal_in_color.dot(color_from_depth.translation());
  int known = 0;
  for (int y = 20; y < 100; ++y) {
    for (int x = 20; x < 140; ++x) {
      const float z = registered.at<float>(y, x);
      if (std::isnan(z)) continue;
      ++known;
      const double expected =
          offset / normal_in_color.dot(unproject(color_camera, Eigen::Vector2d(x, y)));
      // Half a pixel on a plane tilted by 20 degrees: 0.36 * 1.3 m / 132 px / 2, and the near one
      // of two overlapping samples wins.
      EXPECT_NEAR(static_cast<double>(z), expected, 0.004);
    }
  }
  EXPECT_EQ(known, 80 * 120) << "cracks";
}

TEST(Registration, TheNearestWinsAndTheUnknownStaysUnknown) {
  const Camera camera = pinhole(8, 8, 8, 8, 3.5, 3.5);
  cv::Mat depth(8, 8, CV_32F, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(cv::countNonZero(registered_depth(depth, camera, camera, Pose()) > 0), 0);
  depth.at<float>(3, 4) = 2.0F;
  depth.at<float>(3, 3) = 1.0F;
  // Seen from 3 cm to the right and 1 m back both fall close together: the near one covers.
  const cv::Mat same = registered_depth(depth, camera, camera, Pose());
  EXPECT_FLOAT_EQ(same.at<float>(3, 3), 1.0F);
  EXPECT_FLOAT_EQ(same.at<float>(3, 4), 2.0F);
  const Camera coarse = resized(camera, 2, 2);
  EXPECT_FLOAT_EQ(registered_depth(depth, camera, coarse, Pose()).at<float>(0, 0), 1.0F);
}

}  // namespace
}  // namespace armsreach
