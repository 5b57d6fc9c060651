// Camera models: project and unproject invert each other, Jacobians agree with differences, and
// the polynomial and fisheye models agree with OpenCV's.
#include "vision/core/camera.hpp"

#include <random>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

namespace armsreach {
namespace {

std::vector<Camera> cameras() {
  std::vector<Camera> all(5, pinhole(640, 480, 525, 520, 319.5, 239.5));
  all[1].coefficients = {0.12, -0.25, 0.001, -0.0007, 0.1};
  all[2].distortion = Distortion::rational_polynomial;
  all[2].coefficients = {0.3, -0.1, 0.0005, 0.0003, 0.01, 0.5, -0.05, 0.02};
  all[3].distortion = Distortion::fisheye;
  all[3].coefficients = {-0.03, 0.01, -0.004, 0.0005};
  all[3].fx = all[3].fy = 260;
  all[4] = pinhole(320, 240, 195, 195, 162, 125);
  all[4].distortion = Distortion::monoslam;
  all[4].coefficients = {9e-6};
  return all;
}

std::vector<Eigen::Vector2d> pixels(const Camera& camera) {
  std::vector<Eigen::Vector2d> all = {{camera.cx, camera.cy}};
  for (double u : {0.02, 0.3, 0.6, 0.98}) {
    for (double v : {0.02, 0.4, 0.98}) all.emplace_back(u * camera.width, v * camera.height);
  }
  return all;
}

TEST(Camera, ProjectInvertsUnproject) {
  for (const Camera& camera : cameras()) {
    for (const Eigen::Vector2d& pixel : pixels(camera)) {
      const Eigen::Vector3d point = 2.5 * unproject(camera, pixel);
      const auto back = project(camera, point);
      ASSERT_TRUE(back) << name(camera.distortion) << " " << pixel.transpose();
      EXPECT_LT((*back - pixel).norm(), 1e-7) << name(camera.distortion) << pixel.transpose();
    }
  }
}

TEST(Camera, JacobiansAgreeWithDifferences) {
  constexpr double kStep = 1e-6;
  for (const Camera& camera : cameras()) {
    for (const Eigen::Vector2d& pixel : pixels(camera)) {
      Eigen::Matrix2d ray_by_pixel;
      const Eigen::Vector3d point = 1.7 * unproject(camera, pixel, &ray_by_pixel);
      Eigen::Matrix<double, 2, 3> pixel_by_point;
      ASSERT_TRUE(project(camera, point, &pixel_by_point));
      for (int i = 0; i < 3; ++i) {
        Eigen::Vector3d step = Eigen::Vector3d::Zero();
        step[i] = kStep;
        const Eigen::Vector2d slope =
            (*project(camera, point + step) - *project(camera, point - step)) / (2 * kStep);
        EXPECT_LT((slope - pixel_by_point.col(i)).norm(), 1e-4 * (1 + slope.norm()))
            << name(camera.distortion);
      }
      for (int i = 0; i < 2; ++i) {
        Eigen::Vector2d step = Eigen::Vector2d::Zero();
        step[i] = 1e-4;
        const Eigen::Vector2d slope =
            (unproject(camera, pixel + step) - unproject(camera, pixel - step)).head<2>() / 2e-4;
        EXPECT_LT((slope - ray_by_pixel.col(i)).norm(), 1e-6) << name(camera.distortion);
      }
    }
  }
}

TEST(Camera, AgreesWithOpenCv) {
  for (const Camera& camera : cameras()) {
    if (camera.distortion == Distortion::monoslam) continue;
    const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    const std::vector<cv::Point3d> points = {{0.3, -0.2, 1.5}, {0, 0, 1}, {-0.5, 0.4, 1.2}};
    std::vector<cv::Point2d> expected;
    if (camera.distortion == Distortion::fisheye) {
      const cv::Vec4d d(camera.coefficients.data());
      cv::fisheye::projectPoints(points, expected, cv::Vec3d(), cv::Vec3d(), k, d);
    } else {
      const std::vector<double> d(camera.coefficients.begin(), camera.coefficients.end());
      cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), k, d, expected);
    }
    for (size_t i = 0; i < points.size(); ++i) {
      const auto pixel = project(camera, {points[i].x, points[i].y, points[i].z});
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->x(), expected[i].x, 1e-9);
      EXPECT_NEAR(pixel->y(), expected[i].y, 1e-9);
    }
  }
}

TEST(Camera, RefusesWhatItCannotSee) {
  EXPECT_FALSE(project(pinhole(640, 480, 500, 500, 320, 240), {0.1, 0.1, -1}));
  EXPECT_FALSE(project(pinhole(640, 480, 500, 500, 320, 240), {0.1, 0.1, 0}));
  Camera folding = pinhole(640, 480, 500, 500, 320, 240);
  folding.coefficients = {-0.4};  // grows outwards only up to r = 0.91
  EXPECT_TRUE(project(folding, {0.8, 0, 1}));
  EXPECT_FALSE(project(folding, {1.2, 0, 1}));
}

TEST(Camera, ResizedSeesTheSameRays) {
  for (const Camera& camera : cameras()) {
    const Camera half = resized(camera, camera.width / 2, camera.height / 2);
    // The centre of the small image's pixel (0,0) is the corner shared by four large pixels.
    const Eigen::Vector3d large = unproject(camera, {0.5, 0.5});
    const Eigen::Vector3d small = unproject(half, {0, 0});
    EXPECT_LT((large - small).norm(), 1e-9) << name(camera.distortion);
  }
}

}  // namespace
}  // namespace armsreach
