#include "vision/mono_slam/patch.hpp"

#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/cameras.hpp"
#include "tests/unit/vision/mono_slam/pictures.hpp"
#include "vision/mono_slam/search.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// A picture on the plane z = 1, seen from a pose.
cv::Mat view_of_plane(const cv::Mat& picture, const Camera& camera, const Pose& world_from_camera) {
  cv::Mat from_x(camera.height, camera.width, CV_32FC1);
  cv::Mat from_y(camera.height, camera.width, CV_32FC1);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Vector3d ray = world_from_camera.rotation() * unproject(camera, Vector2d(x, y));
      const Vector3d origin = world_from_camera.translation();
      const Vector3d point = origin + (1 - origin.z()) / ray.z() * ray;
      from_x.at<float>(y, x) = static_cast<float>(picture.cols / 2 + 300 * point.x());
      from_y.at<float>(y, x) = static_cast<float>(picture.rows / 2 + 300 * point.y());
    }
  }
  cv::Mat out;
  cv::remap(picture, out, from_x, from_y, cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return out;
}

TEST(Patch, WarpIsTheIdentityFromTheFirstView) {
  const Camera camera = test::wide_angle();
  const cv::Mat image = test::speckles(320, 240, 1);
  const Patch patch = patch_at(image, {90, 70}, 15, camera, Pose());
  const Vector3d point = 1.4 * unproject(camera, {90, 70});
  EXPECT_LT((warp(patch, point, camera, Pose()) - Matrix2d::Identity()).norm(), 1e-9);
  const Template original = patch.original();
  EXPECT_EQ(static_cast<int>(original.samples[0]), image.at<unsigned char>(63, 83));
}

TEST(Patch, HalfAsFarIsTwiceAsLarge) {
  const Camera camera = pinhole(320, 240, 200, 200, 159.5, 119.5);
  const Patch patch = patch_at(test::speckles(320, 240, 1), {160, 120}, 15, camera, Pose());
  const Vector3d point = 2 * unproject(camera, {160, 120});
  const Pose nearer(Eigen::Quaterniond::Identity(), 0.5 * point);
  EXPECT_LT((warp(patch, point, camera, nearer) - 0.5 * Matrix2d::Identity()).norm(), 0.01);
}

TEST(Patch, ATurnAboutTheAxisTurnsThePatch) {
  const Camera camera = pinhole(320, 240, 200, 200, 159.5, 119.5);
  const Patch patch = patch_at(test::speckles(320, 240, 1), {160, 120}, 15, camera, Pose());
  const Vector3d point = 2 * unproject(camera, {160, 120});
  const Pose turned(so3_exp({0, 0, 0.3}), Vector3d::Zero());
  Matrix2d expected;  // the image turns against the camera
  expected << std::cos(0.3), -std::sin(0.3), std::sin(0.3), std::cos(0.3);
  EXPECT_LT((warp(patch, point, camera, turned) - expected).norm(), 0.01);
}

// From 30 deg to the side, nearer and rolled: found where it is if warped, not found unwarped.
TEST(Patch, IsRecognisedFromTheSideOnlyWhenWarped) {
  const Camera camera = test::wide_angle();
  const cv::Mat picture = test::speckles(1200, 1200, 9, 5);
  const cv::Mat first = view_of_plane(picture, camera, Pose());
  Patch patch = patch_at(first, {165, 120}, 15, camera, Pose());
  const Vector3d point = unproject(camera, {165, 120});
  const Pose side(so3_exp({0, -0.5, 0.35}), Vector3d(0.45, 0.02, 0.15));
  SearchImage now;
  now.set(view_of_plane(picture, camera, side));
  const auto expected = project(camera, side.inverse() * point);
  ASSERT_TRUE(expected);
  patch.normal_in_world = -Vector3d::UnitZ();
  const Region around = square(*expected, 8);
  const auto match = search(now, warped(patch, warp(patch, point, camera, side)), around, 0.9);
  ASSERT_TRUE(match);
  EXPECT_LT((match->pixel - *expected).norm(), 0.3);
  EXPECT_FALSE(search(now, patch.original(), around, 0.9));
}

TEST(Patch, ReachesBeyondTheImagesEdge) {
  const Patch patch =
      patch_at(test::speckles(320, 240, 1), {3, 236}, 15, test::wide_angle(), Pose());
  EXPECT_EQ(patch.grey.at<unsigned char>(16, 0), patch.grey.at<unsigned char>(16, 13));
}

}  // namespace
}  // namespace armsreach::mono_slam
