#include "vision/mono_slam/camera_motion.hpp"

#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/cameras.hpp"
#include "tests/unit/vision/mono_slam/numeric.hpp"

namespace armsreach::mono_slam {
namespace {

using test::moving_state;

CameraControl some_control() {
  return {Pose(so3_exp({0.1, -0.3, 0.05}), Eigen::Vector3d(0.02, -0.01, 0.03))};
}

// Second-order errors of central differences at a step of 1e-6 and rounding are below 1e-8.
constexpr double kTolerance = 1e-7;

TEST(CameraMotion, JacobianIsTheDerivativeWithAndWithoutControl) {
  for (const auto& control : {std::optional<CameraControl>(), std::optional(some_control())}) {
    CameraCovariance analytic;
    const CameraState state = moving_state();
    const CameraState expected = moved(state, 0.1, control, &analytic);
    const auto numeric = test::numeric_jacobian(
        [&](const Eigen::VectorXd& error) -> Eigen::VectorXd {
          return difference(moved(corrected(state, error), 0.1, control), expected);
        },
        kCameraRows);
    EXPECT_LT((analytic - numeric).cwiseAbs().maxCoeff(), kTolerance) << "control " << !!control;
  }
}

TEST(CameraMotion, CorrectionAndDifferenceAreInverse) {
  CameraError error;
  error << 0.1, 0.2, -0.3, 0.4, -0.2, 0.1, 1, 2, 3, -1, -2, -3, 0.01;
  const CameraState state = moving_state();
  EXPECT_LT((difference(corrected(state, error), state) - error).norm(), 1e-12);
}

TEST(CameraMotion, ConstantVelocityOverManyStepsIsThatOfOne) {
  CameraState state = moving_state();
  for (int i = 0; i < 10; ++i) state = moved(state, 0.01, std::nullopt);
  const CameraState once = moved(moving_state(), 0.1, std::nullopt);
  EXPECT_LT(difference(state, once).norm(), 1e-12);
}

TEST(CameraMotion, AStillCameraFollowsItsControlExactly) {
  CameraState state;
  const CameraControl control = some_control();
  const Pose after = moved(state, 0.1, control).world_from_camera();
  EXPECT_LT((after.inverse() * control.before_from_after).log().norm(), 1e-12);
}

// The wearer turns about the vertical and goes on doing so while the gimbal rolls the camera: in
// the camera's new axes the same turn.
TEST(CameraMotion, TheCarriersTurnIsSeenInTheNewAxes) {
  CameraState state;
  state.angular_velocity = {0, 1, 0};
  const CameraControl roll{Pose(so3_exp({0, 0, 1.5707963267948966}), Eigen::Vector3d::Zero())};
  const CameraState after = moved(state, 0, roll);
  EXPECT_LT((after.rotation * after.angular_velocity - Eigen::Vector3d(0, 1, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace armsreach::mono_slam
