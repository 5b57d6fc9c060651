#include "vision/mono_slam/point.hpp"

#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/cameras.hpp"
#include "tests/unit/vision/mono_slam/numeric.hpp"

namespace armsreach::mono_slam {
namespace {

using test::moving_state;

// In pixels per unit; derivatives are up to some 1e3, so this is about 1e-9 of them.
constexpr double kTolerance = 1e-5;

Point in_front(PointKind kind) {
  const NewRay ray = ray_through(test::wide_angle(), moving_state(), {100, 80});
  Point point = ray.point;
  point.kind = kind;
  if (kind == PointKind::position) point.values = ray.point.at(1.3);
  if (kind == PointKind::inverse_depth) {
    point.values.conservativeResize(6);
    point.values[5] = 0.7;
  }
  return point;
}

// From a little to the side, so that no derivative vanishes.
CameraState second_view() {
  CameraState state = moving_state();
  state.position += Eigen::Vector3d(0.1, 0.05, -0.02);
  return state;
}

CameraState with_rolling_shutter(CameraState state) {
  state.readout = 0.03;
  return state;
}

void expect_derivatives(const Camera& camera, const CameraState& state) {
  for (const PointKind kind : {PointKind::position, PointKind::inverse_depth}) {
    const Point point = in_front(kind);
    const auto seen = sighting(camera, state, point);
    ASSERT_TRUE(seen);
    const auto by_camera = test::numeric_jacobian(
        [&](const Eigen::VectorXd& error) -> Eigen::VectorXd {
          return sighting(camera, corrected(state, error), point)->pixel;
        },
        kCameraRows);
    const auto by_point = test::numeric_jacobian(
        [&](const Eigen::VectorXd& error) -> Eigen::VectorXd {
          Point other = point;
          other.values += error;
          return sighting(camera, state, other)->pixel;
        },
        rows_of(kind));
    EXPECT_LT((seen->by_camera - by_camera).cwiseAbs().maxCoeff(), kTolerance);
    EXPECT_LT((seen->by_point - by_point).cwiseAbs().maxCoeff(), kTolerance);
  }
}

TEST(PointSighting, JacobiansAreTheDerivatives) {
  for (const Camera& camera : test::cameras()) {
    expect_derivatives(camera, second_view());
    expect_derivatives(camera, with_rolling_shutter(second_view()));
  }
}

// A camera that turns while its lines are read sees what is at the top as it was before.
TEST(PointSighting, ARollingShutterShearsWhatATurningCameraSees) {
  const Camera camera = pinhole(320, 240, 264, 264, 159.5, 119.5);
  CameraState state;
  state.angular_velocity = {0, 0.5, 0};
  const auto shift = [&](double y) {
    Point point;
    point.values = unproject(camera, {160, y});
    return sighting(camera, with_rolling_shutter(state), point)->pixel.x() -
           sighting(camera, state, point)->pixel.x();
  };
  // 264 px a radian, 0.5 rad/s, half of 0.03 s: turning right, things move left. Less one line of
  // 240 between the lines' middles and their edges.
  EXPECT_NEAR(shift(camera.height - 1), -1.98, 0.02);
  EXPECT_NEAR(shift(0), 1.98, 0.02);
  EXPECT_NEAR(shift(0.5 * (camera.height - 1)), 0, 1e-3);
}

TEST(PointSighting, JacobiansAlongARayAreTheDerivatives) {
  for (const Camera& camera : test::cameras()) {
    const CameraState state = second_view();
    const Point ray = in_front(PointKind::ray);
    const auto seen = sighting_along(camera, state, ray, 0.9);
    ASSERT_TRUE(seen);
    const auto by_point = test::numeric_jacobian(
        [&](const Eigen::VectorXd& error) -> Eigen::VectorXd {
          Point other = ray;
          other.values += error;
          return sighting_along(camera, state, other, 0.9)->pixel;
        },
        5);
    EXPECT_LT((seen->by_point - by_point).cwiseAbs().maxCoeff(), kTolerance);
  }
}

TEST(PointSighting, AllKindsSeeTheSamePlace) {
  const Camera camera = test::wide_angle();
  const CameraState state = second_view();
  Point inverse = in_front(PointKind::inverse_depth);
  inverse.values[5] = 1 / 1.3;
  const auto as_position = sighting(camera, state, in_front(PointKind::position));
  const auto as_inverse = sighting(camera, state, inverse);
  const auto along = sighting_along(camera, state, in_front(PointKind::ray), 1.3);
  ASSERT_TRUE(as_position && as_inverse && along);
  EXPECT_LT((as_position->pixel - as_inverse->pixel).norm(), 1e-9);
  EXPECT_LT((as_position->pixel - along->pixel).norm(), 1e-9);
}

TEST(PointSighting, AnInfinitelyFarPointIsSeenInItsDirection) {
  Point far = in_front(PointKind::inverse_depth);
  far.values[5] = 0;
  const auto seen = sighting(test::wide_angle(), second_view(), far);
  ASSERT_TRUE(seen);
  EXPECT_LT((seen->pixel - Eigen::Vector2d(100, 80)).norm(), 1e-9);
}

TEST(PointSighting, NothingIsSeenBehindTheCamera) {
  Point behind;
  behind.values = moving_state().world_from_camera() * Eigen::Vector3d(0.1, 0.1, -1);
  EXPECT_FALSE(sighting(test::wide_angle(), moving_state(), behind));
}

void expect_ray(const Camera& camera, const CameraState& state, double tolerance) {
  for (const Eigen::Vector2d& pixel :
       {Eigen::Vector2d(20, 30), Eigen::Vector2d(161, 121), Eigen::Vector2d(300, 200)}) {
    const NewRay ray = ray_through(camera, state, pixel);
    const auto seen = sighting_along(camera, state, ray.point, 2);
    ASSERT_TRUE(seen);
    EXPECT_LT((seen->pixel - pixel).norm(), tolerance);
    // A ray's values are in its own axes: another ray's direction, written in them.
    const auto values = [&](const Point& other) -> Eigen::VectorXd {
      const Eigen::Vector3d local = ray.point.axes.transpose() * other.direction();
      Eigen::VectorXd out(5);
      out << other.values.head<3>(), local.y() / local.x(), local.z() / local.x();
      return out;
    };
    const auto by_camera = test::numeric_jacobian(
        [&](const Eigen::VectorXd& error) {
          return values(ray_through(camera, corrected(state, error), pixel).point);
        },
        kCameraRows);
    const auto by_pixel = test::numeric_jacobian(
        [&](const Eigen::VectorXd& error) {
          return values(ray_through(camera, state, pixel + error).point);
        },
        2, 1e-4);
    EXPECT_LT((ray.by_camera - by_camera).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_LT((ray.by_pixel - by_pixel).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(NewRay, GoesThroughItsPixelAndHasTheDerivativesOfThat) {
  for (const Camera& camera : test::cameras()) {
    expect_ray(camera, moving_state(), 1e-6);
    // At this fast turn, 1.5 rad/s, its line is guessed wrong by some pixels, during which what is
    // seen moves by up to 0.2.
    expect_ray(camera, with_rolling_shutter(moving_state()), 0.25);
  }
}

}  // namespace
}  // namespace armsreach::mono_slam
