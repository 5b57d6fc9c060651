// Where the camera on its gimbal shall look: it follows what is seen in the image, leaps to a
// point, holds a point or a direction while the wearer moves, or rests.
//
// Measurements come late and with their own times. Each is brought into the mount's frame with the
// gimbal's angles of that time; there the gimbal's own motion is gone from it, so that no delay
// can make the loop swing. What remains, the motion of the target and of the mount, is predicted to
// the moment at which the axes will have obeyed.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "vision/core/camera.hpp"
#include "vision/core/event.hpp"
#include "vision/core/gimbal.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/time.hpp"
#include "vision/gaze/inverse_kinematics.hpp"
#include "vision/gaze/point_predictor.hpp"

namespace armsreach {

struct GazeSettings {
  double distance = 0.5;  // m, of what is followed, where nobody measures it
  // Calmer than a hand that is measured exactly would need: prediction through 0.15 s makes five
  // times as much of the noise of a blob's place otherwise.
  PointNoise followed{0.012, 1, 0.3};
  PointNoise fixated{0.002, 2, 0.3};
  // s beyond the gimbal's lag for which the target is predicted: the axes take about this long for
  // the way between two commands.
  double lead = 0.025;
  double arrived = 0.0087;                // rad, off the target when a saccade has ended
  Eigen::Vector3d up_in_mount{0, -1, 0};  // while no pose is known
  Eigen::Vector3d up_in_world{0, 0, 1};   // once there are poses
};

// A target in the image: a hand, the middle between two, an object, where a grasp points to.
struct TargetSeen {
  Timestamp time = 0;
  Eigen::Vector2d pixel{0, 0};     // may lie outside of the image
  std::optional<double> distance;  // m from the camera, where it is known
};

struct CameraPoseSeen {
  Timestamp time = 0;
  Pose world_from_camera;
};

// What is new since the last step.
struct GazeInput {
  Timestamp now = 0;                   // when the command will be given
  std::optional<GimbalState> gimbal;   // the newest that is known; the frame's own does
  std::optional<TargetSeen> target;    // used to follow
  std::optional<CameraPoseSeen> pose;  // used for points in the world
};

class GazeController {
 public:
  GazeController(const GimbalModel& model, const Camera& camera, const GazeSettings& settings = {});

  // What to do from now on; each is an event. `name` says what is looked at.
  void follow(const std::string& name = "");
  // What follows needs poses and waits for one.
  // To a point, also outside of the image, and then holds it.
  void saccade_to_world(const Eigen::Vector3d& point, const std::string& name = "");
  // The same without a leap being announced.
  void fixate_in_world(const Eigen::Vector3d& point, const std::string& name = "");
  // Holds the direction in which it looks at the next pose, against the turning of the mount.
  void stabilise();
  void rest();

  GimbalCommand step(const GazeInput& input);

  GazeMode mode() const { return mode_; }
  // Whether the last command looks at the target within the limits.
  bool reachable() const { return solution_.reachable(); }
  Events take_events();

 private:
  struct MountSeen {
    Timestamp time;
    Pose world_from_mount;
  };
  void begin(GazeMode mode, const std::string& name);
  void aim_at(GazeMode mode, const std::optional<Eigen::Vector3d>& point, const std::string& name);
  void see_target(const TargetSeen& seen);
  void see_pose(const CameraPoseSeen& seen);
  Eigen::Vector3d up_in_mount() const;
  void end_saccade();
  void announce(Timestamp now);

  GimbalModel model_;
  Camera camera_;
  GazeSettings settings_;
  std::deque<GimbalState> states_;  // of the last two seconds

  GazeMode mode_ = GazeMode::rest;
  bool announced_ = true;
  std::string name_;
  // In the world, of a saccade or a fixation; nothing while a direction waits for a pose.
  std::optional<Eigen::Vector3d> goal_;
  PointPredictor predictor_;      // of a target that moves in the mount's frame
  std::deque<MountSeen> mounts_;  // of the last half second
  GimbalSolution solution_;
  Events events_;
};

}  // namespace armsreach
