#include "vision/mono_slam/depth_particles.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/cameras.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector3d;

double weight_sum(const DepthParticles& particles) {
  double sum = 0;
  for (const DepthParticle& p : particles.particles()) sum += p.weight;
  return sum;
}

TEST(DepthParticles, StartEvenlySpread) {
  const DepthParticles particles(100, 0.5, 5);
  EXPECT_EQ(particles.particles().size(), 100U);
  EXPECT_NEAR(particles.mean(), 2.75, 1e-9);
  EXPECT_NEAR(particles.sigma() / particles.mean(), 0.47, 0.01);
  EXPECT_NEAR(weight_sum(particles), 1, 1e-12);
}

// The camera slides sideways by half a metre in all, its own place known to a millimetre.
TEST(DepthParticles, FindTheDepthOfAPointSeenFromTheSide) {
  for (const double truth : {0.7, 1.4, 3.0}) {
    Filter filter(test::wide_angle(), 10, 0.5);
    CameraState camera;
    filter.start(camera, 1e-6 * CameraCovariance::Identity());
    const auto ray = filter.add_ray({150, 110});
    ASSERT_TRUE(ray);
    const Vector3d place = filter.point(*ray).at(truth);
    DepthParticles particles(100, 0.5, 5);
    for (int i = 1; i <= 20; ++i) {
      camera.position.x() = -0.025 * i;
      filter.replace_camera(camera, 1e-6 * CameraCovariance::Identity());
      const auto pixel = project(filter.camera(), camera.world_from_camera().inverse() * place);
      ASSERT_TRUE(pixel);
      particles.weigh(particles.predict(filter, *ray), *pixel, 0.05);
      ASSERT_NEAR(weight_sum(particles), 1, 1e-9);
    }
    EXPECT_NEAR(particles.mean(), truth, 0.1);
    EXPECT_LT(particles.sigma(), 0.1 * truth);
    EXPECT_LT(particles.particles().size(), 60U);
  }
}

TEST(DepthParticles, NothingIsLeftWhereNothingFits) {
  Filter filter(test::wide_angle(), 10, 0.5);
  filter.start(CameraState(), 1e-6 * CameraCovariance::Identity());
  const auto ray = filter.add_ray({150, 110});
  DepthParticles particles(100, 0.5, 5);
  particles.weigh(particles.predict(filter, *ray), {5000, 5000}, 0.05);
  EXPECT_TRUE(particles.particles().empty());
}

}  // namespace
}  // namespace armsreach::mono_slam
