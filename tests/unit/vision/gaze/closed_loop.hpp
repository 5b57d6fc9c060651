// A gimbal's camera in a loop with whatever commands it: a target and a wearer that move as told,
// measurements that come late. No pictures: a target is where the true camera projects it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vision/core/camera.hpp"
#include "vision/core/gimbal.hpp"
#include "vision/core/pose.hpp"
#include "vision/gaze/gaze_controller.hpp"

namespace armsreach {

struct Loop {
  std::function<Eigen::Vector3d(double)> target_in_world;
  std::function<Pose(double)> world_from_mount = [](double) { return Pose(); };
  GimbalModel model;
  Camera camera = pinhole(640, 480, 381, 381, 319.5, 239.5);  // 80 degrees wide
  double delay = 0.1;                                         // s, of targets and poses
  double rate = 30;                                           // Hz
  double seconds = 6;
};

// At one frame, in truth.
struct LoopSample {
  double time = 0;
  double off = 0;           // rad, between the optical axis and the target
  Eigen::Vector2d bearing;  // rad, of the target: to the right, downwards
  double torsion = 0;       // rad, between the image's x axis and the horizon
  Eigen::Vector3d angles;   // of the gimbal
  GazeMode mode;
};

// What commands: gets the measurements of a frame, gives angles.
using Commander = std::function<GimbalCommand(const GazeInput&)>;
std::vector<LoopSample> run(
    const Loop& loop, const Commander& commander,
    const std::function<GazeMode()>& mode = [] { return GazeMode::rest; });

// The controller itself; `instruct` is called with the time before each frame's step.
std::vector<LoopSample> run(
    const Loop& loop, GazeController& controller,
    const std::function<void(double)>& instruct = [](double) {});

double rms_off(const std::vector<LoopSample>& samples, double from, double to);

}  // namespace armsreach
