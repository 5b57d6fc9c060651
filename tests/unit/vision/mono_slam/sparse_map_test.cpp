#include "vision/mono_slam/sparse_map.hpp"

#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/cameras.hpp"
#include "tests/unit/vision/mono_slam/pictures.hpp"

namespace armsreach::mono_slam {
namespace {

SparseMap some_map() {
  SparseMap map;
  map.camera = test::wide_angle();
  for (int i = 0; i < 3; ++i) {
    Landmark landmark;
    landmark.attempts = 10 + i;
    landmark.successes = 7;
    landmark.of_target = i == 1;
    landmark.patch = patch_at(test::speckles(320, 240, i), {100.25, 80.5 + i}, 15,
                              test::wide_angle(), test::moving_state().world_from_camera());
    map.landmarks.push_back(landmark);
    map.points_in_world.emplace_back(0.1 * i, 1, 2);
  }
  Eigen::MatrixXd root(9, 9);
  for (int i = 0; i < 81; ++i) root(i) = std::sin(1.0 + i);
  map.covariance = root * root.transpose() + Eigen::MatrixXd::Identity(9, 9);
  return map;
}

std::string written(const SparseMap& map) {
  std::ostringstream out;
  write_sparse_map(out, map);
  return out.str();
}

TEST(SparseMap, ComesBackAsItWas) {
  const SparseMap map = some_map();
  std::istringstream in(written(map));
  const auto read = read_sparse_map(in, "map");
  ASSERT_TRUE(read) << read.error().message();
  ASSERT_EQ(read->landmarks.size(), 3U);
  EXPECT_EQ(read->camera.distortion, Distortion::monoslam);
  EXPECT_EQ(read->camera.fx, map.camera.fx);
  EXPECT_EQ(read->camera.coefficients, map.camera.coefficients);
  EXPECT_EQ(read->points_in_world, map.points_in_world);
  EXPECT_LT((read->covariance - map.covariance).cwiseAbs().maxCoeff(), 1e-15);
  for (std::size_t i = 0; i < 3; ++i) {
    const Landmark& a = read->landmarks[i];
    const Landmark& b = map.landmarks[i];
    EXPECT_EQ(a.successes, b.successes);
    EXPECT_EQ(a.of_target, b.of_target);
    EXPECT_EQ(a.patch.pixel, b.patch.pixel);
    EXPECT_EQ(cv::norm(a.patch.grey, b.patch.grey, cv::NORM_L1), 0);
    EXPECT_EQ(a.latest.samples, b.patch.original().samples);
  }
  EXPECT_EQ(written(*read), written(map));
}

TEST(SparseMap, AnyTruncationIsAnError) {
  const std::string bytes = written(some_map());
  for (std::size_t length = 0; length < bytes.size(); length += 13) {
    std::istringstream in(bytes.substr(0, length));
    const auto read = read_sparse_map(in, "map");
    ASSERT_FALSE(read) << length;
    EXPECT_EQ(read.error().where, "map");
  }
}

TEST(SparseMap, WhatCannotBeIsAnError) {
  const auto refused = [](const SparseMap& map) {
    std::istringstream in(written(map));
    return !read_sparse_map(in, "map").ok();
  };
  SparseMap far = some_map();
  far.points_in_world[1].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused(far));
  SparseMap negative = some_map();
  negative.covariance(4, 4) = -1;
  EXPECT_TRUE(refused(negative));
  SparseMap size = some_map();
  size.landmarks[0].patch.size = 200;
  EXPECT_TRUE(refused(size));
  SparseMap blind = some_map();
  blind.camera.fx = 0;
  EXPECT_TRUE(refused(blind));
  std::istringstream other("this is a text about maps");
  EXPECT_FALSE(read_sparse_map(other, "map"));
}

TEST(SparseMap, WhatFollowsTheMapIsAnError) {
  std::istringstream in(written(some_map()) + 'x');
  const auto read = read_sparse_map(in, "map");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().what.find("goes on"), std::string::npos);
}

TEST(SparseMap, AMapThatDoesNotNameItsCameraIsAnError) {
  std::string bytes = written(some_map());
  bytes[7] = '1';
  std::istringstream in(bytes);
  const auto read = read_sparse_map(in, "map");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().what.find("older version"), std::string::npos);
}

TEST(SparseMap, IsOfOneCamera) {
  const SparseMap map = some_map();
  Camera camera = map.camera;
  EXPECT_TRUE(check_same_camera(map, camera, "map"));
  camera.fx += 1;  // calibrated again
  EXPECT_TRUE(check_same_camera(map, camera, "map"));
  camera.fx = 300;
  const Status refused = check_same_camera(map, camera, "map");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where, "map");
  EXPECT_NE(refused.error().what.find("195.0"), std::string::npos);
  camera = map.camera;
  camera.coefficients[0] = 0;
  EXPECT_FALSE(check_same_camera(map, camera, "map"));
  EXPECT_FALSE(check_same_camera(map, resized(map.camera, 160, 120), "map"));
}

}  // namespace
}  // namespace armsreach::mono_slam
