// Trajectories: timed poses, the TUM text codec and the errors between two of them.
#pragma once

#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "vision/core/pose.hpp"
#include "vision/core/result.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

struct TimedPose {
  Timestamp time = 0;
  Pose world_from_camera;
};
using Trajectory = std::vector<TimedPose>;

// "time tx ty tz qx qy qz qw" a line, '#' comments. Errors name the line.
Result<Trajectory> read_tum_trajectory(std::istream& in, const std::string& where);
void write_tum_pose(std::ostream& out, const TimedPose& pose);

// The pose nearest to a time, within 20 ms. The trajectory is sorted.
std::optional<Pose> pose_at(const Trajectory& trajectory, Timestamp time);

// Similarity: point_in_truth = scale * rotation * point_in_estimate + translation.
struct Alignment {
  Pose truth_from_estimate;
  double scale = 1;
};

struct TrajectoryErrors {
  int pairs = 0;        // poses of the estimate that have a partner in the truth
  double coverage = 0;  // pairs / poses of the truth within its span
  Alignment alignment;
  double ate_rmse = 0;                // m
  double ate_max = 0;                 // m
  double rpe_frame_translation = 0;   // m, rms between neighbouring pairs
  double rpe_frame_rotation = 0;      // rad, rms
  double rpe_second_translation = 0;  // m, rms over one second; 0 when shorter
  double rpe_second_rotation = 0;     // rad
};

// Absolute trajectory error after the least-squares alignment of Umeyama (1991), relative pose
// errors after Sturm et al. (2012). Poses are paired when within 20 ms. Nothing with under 3 pairs.
std::optional<TrajectoryErrors> trajectory_errors(const Trajectory& estimate,
                                                  const Trajectory& truth, bool with_scale);

}  // namespace armsreach
