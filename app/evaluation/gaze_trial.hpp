// The gaze controller in a closed loop with a simulated camera on its gimbal. It is told where the
// target is, or where the camera is, by the truth, a while late: what is measured is the control.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "devices/rig.hpp"
#include "vision/core/event.hpp"
#include "vision/core/result.hpp"

namespace armsreach::app {

struct GazeTrial {
  GazeMode mode{GazeMode::follow};  // follow, saccade or fixate
  // Names of things or hands. Follow and fixate take the first; saccades go round all of them.
  std::vector<std::string> targets{};
  double delay{0.1};     // s, from a frame to what is found in it
  double interval{1.2};  // s, from one saccade to the next
};

// The truth at one frame.
struct GazeSample {
  double time = 0;
  int saccade = -1;                          // since when the target is what it is; -1: none yet
  double off = 0;                            // rad, between the optical axis and the target
  Eigen::Vector2d bearing{0, 0};             // rad, of the target: to the right, downwards
  bool central = false;                      // within a quarter of the image's width and height
  double torsion = 0;                        // rad, of the image's x axis above the horizon
  Eigen::Vector3d angles{0, 0, 0};           // pan, tilt, roll
  Eigen::Vector3d direction{0, 0, 1};        // unit, of the target in the mount
  Eigen::Vector3d target_in_world{0, 0, 0};  // m
  Eigen::Vector3d mount_in_world{0, 0, 0};   // m
};

struct GazeRun {
  std::vector<GazeSample> samples;
  double half_width = 0;  // rad, from the image's centre to its edge
  Events events;          // of the controller
};

Result<GazeRun> run_gaze_trial(Rig& rig, const GazeTrial& trial);

}  // namespace armsreach::app
