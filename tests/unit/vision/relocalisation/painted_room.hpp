// A room whose walls are painted at random, seen without noise: exact truth for relocalisation.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include <opencv2/core/mat.hpp>

#include "vision/core/frame.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/tracked_frame.hpp"

namespace armsreach::test {

// One camera, 320x240, colour and depth registered.
std::shared_ptr<const SensorInfo> registered_sensor();
// Colour 22 mm beside depth, turned a little, and of another focal length, as a raw Kinect.
std::shared_ptr<const SensorInfo> unregistered_sensor();

class PaintedRoom {
 public:
  explicit PaintedRoom(std::uint64_t seed);  // another seed, other paintings
  // The camera is the one that poses belong to. It must be inside: within 1.4 m of the centre.
  FramePtr frame(const std::shared_ptr<const SensorInfo>& sensor, const Pose& world_from_camera,
                 std::int64_t index = 0) const;

 private:
  std::array<cv::Mat, 6> walls_;  // CV_8UC1
};

TrackedFrame tracked(const FramePtr& frame, TrackingState state = TrackingState::tracking);

// At (x, 0, 0), turned about the vertical.
Pose at(double x, double angle);

}  // namespace armsreach::test
