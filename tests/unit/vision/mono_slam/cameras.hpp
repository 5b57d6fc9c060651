// Cameras and a state to test with.
#pragma once

#include <vector>

#include "vision/core/camera.hpp"
#include "vision/mono_slam/camera_motion.hpp"

namespace armsreach::mono_slam::test {

inline Camera wide_angle() {
  Camera camera = pinhole(320, 240, 195, 195, 162, 125);
  camera.distortion = Distortion::monoslam;
  camera.coefficients[0] = 9e-6;
  return camera;
}

inline Camera plumb_bob() {
  Camera camera = pinhole(320, 240, 264, 262, 160, 119);
  camera.coefficients = {0.12, -0.2, 0.001, -0.002, 0.03};
  return camera;
}

inline std::vector<Camera> cameras() {
  return {wide_angle(), plumb_bob(), pinhole(320, 240, 264, 264, 159.5, 119.5)};
}

inline CameraState moving_state() {
  CameraState state;
  state.position = {0.1, -0.3, 0.2};
  state.rotation = so3_exp({0.2, -0.4, 0.1});
  state.velocity = {0.5, -0.2, 0.3};
  state.angular_velocity = {0.6, 1.1, -0.8};
  return state;
}

}  // namespace armsreach::mono_slam::test
