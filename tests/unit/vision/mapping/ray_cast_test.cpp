#include "vision/mapping/ray_cast.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/vision/mapping/shapes.hpp"
#include "vision/mapping/ray_march.hpp"

namespace armsreach::mapping {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using test::depth_of;
using test::looking_at;
using test::map_of;
using test::small_camera;

struct Errors {
  double median = 0;  // m, absolute
  double p99 = 0;
  double covered = 0;  // share of the truth's pixels that the view has
};

Errors compare(const cv::Mat& depth, const cv::Mat& truth) {
  std::vector<double> errors;
  int known = 0;
  for (int v = 0; v < truth.rows; ++v) {
    for (int u = 0; u < truth.cols; ++u) {
      if (!(truth.at<float>(v, u) > 0)) continue;
      ++known;
      const double error =
          static_cast<double>(depth.at<float>(v, u)) - static_cast<double>(truth.at<float>(v, u));
      if (error == error) errors.push_back(std::abs(error));
    }
  }
  std::sort(errors.begin(), errors.end());
  if (errors.empty()) return {};
  return {errors[errors.size() / 2], errors[errors.size() * 99 / 100],
          static_cast<double>(errors.size()) / known};
}

TEST(RayCast, AWallIsWhereItIsFromOtherViewsToo) {
  const test::Shape wall = test::plane(Vector3d(0.3, 0.1, 1).normalized(), 1.5);
  const VoxelMap map = map_of(wall, {Pose()});
  for (const double shift : {0.0, 0.013, 0.15}) {
    const Pose pose(Eigen::Quaterniond(Eigen::AngleAxisd(shift, Vector3d::UnitY())),
                    {shift, -shift / 2, shift});
    const ReferenceView view = cast(map.grid(), small_camera(), pose);
    const Errors errors = compare(view.depth, depth_of(wall, small_camera(), pose));
    // Interpolated distances of a plane are exact but for float and fixed point.
    EXPECT_LT(errors.median, 5e-5) << shift;
    EXPECT_LT(errors.p99, 2e-4) << shift;
    // The margins that the first view did not see: 0.15 rad and 15 cm of a field of 1.04 rad.
    EXPECT_GT(errors.covered, shift > 0.1 ? 0.6 : 0.95) << shift;
    EXPECT_NEAR(view.intensity.at<float>(30, 40), 0.5F, 1e-3F);
  }
}

TEST(RayCast, ASphereToAFractionOfAVoxel) {
  const test::Shape ball = test::sphere({0, 0, 0}, 0.15);
  std::vector<Pose> poses;
  for (int i = 0; i < 16; ++i) {
    const double a = 0.05 * i;
    poses.push_back(looking_at({std::cos(a), std::sin(a), 0.3}, {0, 0, 0}));
  }
  const VoxelMap map = map_of(ball, poses);
  const Pose between = looking_at({std::cos(0.37), std::sin(0.37), 0.35}, {0, 0, 0});
  cv::Mat normals;
  const ReferenceView view = cast(map.grid(), small_camera(), between, {}, &normals);
  const Errors errors = compare(view.depth, depth_of(ball, small_camera(), between));
  // A pixel is 14 mm wide at 1 m and the voxels 10 mm; a tenth of a voxel is the method's, not the
  // grid's, accuracy.
  EXPECT_LT(errors.median, 1e-3);
  EXPECT_GT(errors.covered, 0.95);
  const cv::Vec3f normal = normals.at<cv::Vec3f>(30, 40);
  const Vector3d eye = between.translation().normalized();
  EXPECT_GT(Vector3d(Vector3f(normal[0], normal[1], normal[2]).cast<double>()).dot(eye), 0.98);
}

TEST(RayCast, TheFirstSurfaceIsSeenAndNothingBehindIt) {
  const test::Shape scene = test::nearest_of(
      {test::plane(Vector3d::UnitY(), 2), test::box({-0.2, 1, -0.2}, {0.2, 1.2, 0.2})});
  const Pose pose = looking_at({0, 0, 0}, {0, 1, 0});
  const VoxelMap map = map_of(
      scene, {pose, looking_at({0.6, 0, 0}, {0.2, 1, 0}), looking_at({-0.6, 0, 0}, {-0.2, 1, 0})});
  const cv::Mat truth = depth_of(scene, small_camera(), pose);
  const ReferenceView view = cast(map.grid(), small_camera(), pose);
  int wrong = 0;
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) {
      wrong += std::abs(view.depth.at<float>(v, u) - truth.at<float>(v, u)) > 0.02F;
    }
  }
  // Pixels on the box's outline: 40 cm of 14 mm pixels a side, and one pixel thick at most.
  EXPECT_LT(wrong, 120);
}

TEST(RayCast, StartingAtTheExpectedDepthSeesTheSame) {
  const test::Shape scene =
      test::nearest_of({test::plane(Vector3d::UnitY(), 1.8), test::sphere({0.1, 1.3, 0.1}, 0.25)});
  const Pose pose = looking_at({0, 0, 0}, {0, 1, 0});
  const VoxelMap map = map_of(scene, {pose, pose});
  const Pose next = looking_at({0.02, 0.01, 0}, {0.03, 1, 0.01});
  RayCastOptions options;
  options.expected_depth = depth_of(scene, small_camera(), next);
  options.weights = cv::Mat(60, 80, CV_32FC1, cv::Scalar(1));
  const ReferenceView full = cast(map.grid(), small_camera(), next);
  const ReferenceView quick = cast(map.grid(), small_camera(), next, options);
  int different = 0;
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) {
      const float a = full.depth.at<float>(v, u);
      const float b = quick.depth.at<float>(v, u);
      // Other steps along the ray end a little elsewhere in the interpolated field.
      different += !((a != a && b != b) || std::abs(a - b) < 5e-4F);
    }
  }
  EXPECT_LT(different, 25) << "outline pixels only";
}

// Rays in faces, edges and corners of blocks, along each axis and both ways, end, and so do those
// that never meet the map or start far outside it.
TEST(RayCast, RaysAlongFacesAndOutsideTheMapEnd) {
  const test::Shape room = test::box({-1, -1, -1}, {1, 1, 1});
  VoxelMap map = map_of(test::plane(Vector3d::UnitZ(), 1), {Pose()});
  Sampler sampler(map.grid());
  int hits = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      for (const float offset : {0.0F, 8.0F, -8.0F, 32.0F, 7.9999995F}) {
        MapRay ray;
        ray.origin = Vector3f::Constant(offset);
        ray.direction = Vector3f::Zero();
        ray.direction[axis] = sign * 100;
        hits += march(sampler, map.grid(), ray, 0, 50).has_value();
        ray.origin[axis] = -sign * 5000;
        hits += march(sampler, map.grid(), ray, 0, 100).has_value();
        ray.direction = Vector3f::Constant(sign * 100);
        march(sampler, map.grid(), ray, 0, 50);
      }
    }
  }
  EXPECT_GE(hits, 10) << "along +z each of them meets the wall";
}

TEST(RayCast, AnEmptyMapIsUnknown) {
  const VoxelMap map{VoxelMapOptions()};
  const ReferenceView view = cast(map.grid(), small_camera(), Pose());
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) {
      ASSERT_TRUE(std::isnan(view.depth.at<float>(v, u)));
      ASSERT_TRUE(std::isnan(view.intensity.at<float>(v, u)));
    }
  }
}

}  // namespace
}  // namespace armsreach::mapping
