#include "vision/relocalisation/three_point.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace armsreach::relocalisation {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Scene {
  Pose camera_from_world{so3_exp({0.2, -0.4, 0.1}), {0.3, -0.1, 0.5}};
  std::vector<Sighting> sightings;
};

// The first `right` sightings are as the pose says, the others point anywhere.
Scene scene(int right, int wrong, bool depth, double ray_noise = 0) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  Scene result;
  for (int i = 0; i < right + wrong; ++i) {
    const double z = uniform(1, 3);
    const Eigen::Vector3d in_camera(z * uniform(-0.5, 0.5), z * uniform(-0.4, 0.4), z);
    Sighting sighting;
    sighting.point_in_world = result.camera_from_world.inverse() * in_camera;
    sighting.ray = in_camera.head<2>() / z +
                   Eigen::Vector2d(uniform(-ray_noise, ray_noise), uniform(-ray_noise, ray_noise));
    sighting.depth = z;
    if (i >= right) {
      sighting.ray = {uniform(-0.5, 0.5), uniform(-0.4, 0.4)};
      sighting.depth = uniform(1, 3);
    }
    if (!depth) sighting.depth = kUnknown;
    result.sightings.push_back(sighting);
  }
  return result;
}

void expect_near(const Pose& found, const Pose& truth, double tolerance) {
  EXPECT_LT((found * truth.inverse()).log().norm(), tolerance);
}

TEST(ThreePoint, FindsThePoseAmongMoreWrongSightingsThanRight) {
  const Scene s = scene(20, 80, true);
  const auto fit = three_point_pose(s.sightings, {});
  ASSERT_TRUE(fit);
  EXPECT_GE(fit->inliers.size(), 20U);
  // Exact points; a wrong sighting within tolerance by chance may pull a little.
  expect_near(fit->camera_from_world, s.camera_from_world, 0.005);
}

TEST(ThreePoint, FindsThePoseWithoutDepth) {
  const Scene s = scene(40, 40, false);
  const auto fit = three_point_pose(s.sightings, {});
  ASSERT_TRUE(fit);
  EXPECT_GE(fit->inliers.size(), 40U);
  expect_near(fit->camera_from_world, s.camera_from_world, 0.005);
}

TEST(ThreePoint, RefiningAveragesTheNoiseOfTheRays) {
  // Uniform noise of half a tolerance: 3 mrad rms. Over 60 points at 2 m the mean is off by
  // 3 mrad * 2 m / sqrt(60) = 0.8 mm, rotation and translation share some: 5 mm in all.
  const Scene s = scene(60, 20, true, 0.005);
  const auto fit = three_point_pose(s.sightings, {});
  ASSERT_TRUE(fit);
  expect_near(fit->camera_from_world, s.camera_from_world, 0.005);
}

TEST(ThreePoint, SightingsThatAgreeOnNothingHaveFewInliers) {
  for (const bool depth : {true, false}) {
    const auto fit = three_point_pose(scene(0, 80, depth).sightings, {});
    // Three agree by construction; any more do by chance, depth leaving less to it.
    EXPECT_LT(fit ? fit->inliers.size() : 0, depth ? 8U : 14U);
  }
}

TEST(ThreePoint, TooFewSightingsHaveNoPose) {
  EXPECT_FALSE(three_point_pose({}, {}));
  EXPECT_FALSE(three_point_pose(scene(3, 0, true).sightings, {}));
}

TEST(ThreePoint, PointsInOnePlaceHaveNoPose) {
  std::vector<Sighting> sightings = scene(1, 0, true).sightings;
  sightings.resize(30, sightings[0]);
  EXPECT_FALSE(three_point_pose(sightings, {}));
}

TEST(ThreePoint, TheSameSeedGivesTheSameBits) {
  const Scene s = scene(20, 60, true, 0.005);
  const auto a = three_point_pose(s.sightings, {.seed = 5});
  const auto b = three_point_pose(s.sightings, {.seed = 5});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->inliers, b->inliers);
  EXPECT_EQ(a->camera_from_world.matrix(), b->camera_from_world.matrix());
}

TEST(ThreePoint, RefinedPoseReachesTheMinimumFromNearby) {
  const Scene s = scene(40, 0, true);
  std::vector<int> all(40);
  for (int i = 0; i < 40; ++i) all[i] = i;
  Vector6d off;
  off << 0.05, -0.03, 0.04, 0.05, 0.03, -0.06;
  const Pose start = Pose::exp(off) * s.camera_from_world;
  // Exact sightings: the minimum is the truth, up to the size of the last step.
  expect_near(refined_pose(start, s.sightings, all, 0.01), s.camera_from_world, 1e-5);
}

}  // namespace
}  // namespace armsreach::relocalisation
