// A furnished room with exact depth and a smooth texture, for tests and benches of dense vision.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "vision/core/frame.hpp"

namespace armsreach::test {

struct Box {
  Eigen::Vector3d least, most;  // corners in the world, m
};

struct SyntheticRoom {
  Box walls{{-1.9, -1.6, -1.5}, {1.7, 1.1, 3.5}};  // seen from inside; y points down
  std::vector<Box> furniture{{{-0.9, 0.2, 1.6}, {0.5, 0.3, 2.6}},     // a table's top
                             {{-0.6, -0.15, 1.9}, {-0.3, 0.2, 2.2}},  // things on it
                             {{0.0, 0.0, 1.8}, {0.25, 0.2, 2.0}},
                             {{0.9, -0.6, 2.3}, {1.6, 1.1, 3.1}}};  // a cupboard
  double brightness = 0;                                            // added to the intensity, 0..1
  double depth_noise = 0;                                           // k [1/m]: deviation k z^2
  double intensity_noise = 0;                                       // deviation, 0..1
  std::uint64_t seed = 1;                                           // of the noise
  bool textured = true;

  // Depth and grey image of an undistorted registered sensor, with the pose as truth.
  FramePtr frame(const std::shared_ptr<const SensorInfo>& sensor, const Pose& world_from_camera,
                 std::int64_t index = 0) const;
};

// 4:3, 30 Hz, a Kinect's field of view.
std::shared_ptr<const SensorInfo> synthetic_sensor(int width = 640);

}  // namespace armsreach::test
