#include "vision/core/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include <Eigen/Geometry>

namespace armsreach {
namespace {

constexpr Timestamp kPairingTolerance = 20'000'000;  // ns

struct Pair {
  TimedPose estimate;
  TimedPose truth;
};

const TimedPose* nearest_in_time(const Trajectory& sorted, Timestamp time) {
  const auto after = std::lower_bound(sorted.begin(), sorted.end(), time,
                                      [](const TimedPose& p, Timestamp t) { return p.time < t; });
  const TimedPose* best = nullptr;
  for (auto candidate : {after, after == sorted.begin() ? after : after - 1}) {
    if (candidate == sorted.end()) continue;
    if (!best || std::abs(candidate->time - time) < std::abs(best->time - time)) best = &*candidate;
  }
  return best && std::abs(best->time - time) <= kPairingTolerance ? best : nullptr;
}

std::vector<Pair> paired(const Trajectory& estimate, const Trajectory& truth) {
  std::vector<Pair> pairs;
  for (const TimedPose& pose : estimate) {
    if (const TimedPose* partner = nearest_in_time(truth, pose.time)) {
      pairs.push_back({pose, *partner});
    }
  }
  return pairs;
}

Alignment align(const std::vector<Pair>& pairs, bool with_scale) {
  Eigen::Matrix3Xd from(3, pairs.size());
  Eigen::Matrix3Xd to(3, pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = pairs[i].estimate.world_from_camera.translation();
    to.col(static_cast<Eigen::Index>(i)) = pairs[i].truth.world_from_camera.translation();
  }
  const Eigen::Matrix4d similarity = Eigen::umeyama(from, to, with_scale);
  Alignment alignment;
  const Eigen::Matrix3d scaled_rotation = similarity.topLeftCorner<3, 3>();
  alignment.scale = std::cbrt(scaled_rotation.determinant());
  const Eigen::Matrix3d rotation = scaled_rotation / alignment.scale;
  alignment.truth_from_estimate =
      Pose(Eigen::Quaterniond(rotation), similarity.topRightCorner<3, 1>());
  return alignment;
}

struct RelativeErrors {
  double translation = 0;
  double rotation = 0;
};

// Rms error of the motion from each pair to the first one at least `span` later.
RelativeErrors relative_errors(const std::vector<Pair>& pairs, Timestamp span, double scale) {
  double translation2 = 0;
  double rotation2 = 0;
  int count = 0;
  size_t j = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    j = std::max(j, i + 1);
    while (j < pairs.size() && pairs[j].truth.time - pairs[i].truth.time < span) ++j;
    if (j >= pairs.size()) break;
    const Pose truth =
        pairs[i].truth.world_from_camera.inverse() * pairs[j].truth.world_from_camera;
    const Pose raw =
        pairs[i].estimate.world_from_camera.inverse() * pairs[j].estimate.world_from_camera;
    const Pose estimate(raw.rotation(), scale * raw.translation());
    const Pose error = truth.inverse() * estimate;
    translation2 += error.translation().squaredNorm();
    rotation2 += so3_log(error.rotation()).squaredNorm();
    ++count;
  }
  if (count == 0) return {};
  return {std::sqrt(translation2 / count), std::sqrt(rotation2 / count)};
}

}  // namespace

Result<Trajectory> read_tum_trajectory(std::istream& in, const std::string& where) {
  const std::string remedy = "each line is: time tx ty tz qx qy qz qw";
  Trajectory trajectory;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line[0] == '#' || line == "\r") continue;
    std::istringstream fields(line);
    double time = 0;
    Eigen::Vector3d t;
    Eigen::Vector4d q;
    fields >> time >> t[0] >> t[1] >> t[2] >> q[0] >> q[1] >> q[2] >> q[3];
    const std::string place = where + ":" + std::to_string(number);
    if (!fields || !std::isfinite(time) || !t.allFinite() || !q.allFinite()) {
      return Error{"not a pose", place, remedy};
    }
    if (std::abs(time) >= kLatestTime) {
      return Error{"the time is beyond 4e9 s", place, "times are numbers of seconds"};
    }
    if (q.norm() < 1e-6) return Error{"the quaternion is zero", place, remedy};
    const TimedPose pose{timestamp_from_seconds(time),
                         Pose(Eigen::Quaterniond(q[3], q[0], q[1], q[2]), t)};
    if (!trajectory.empty() && pose.time < trajectory.back().time) {
      return Error{"time goes backwards", place, "sort the lines by time"};
    }
    trajectory.push_back(pose);
  }
  return trajectory;
}

void write_tum_pose(std::ostream& out, const TimedPose& pose) {
  const Eigen::Vector3d& t = pose.world_from_camera.translation();
  const Eigen::Quaterniond& q = pose.world_from_camera.rotation();
  std::ostringstream line;
  line << std::fixed << std::setprecision(9) << seconds_from_timestamp(pose.time) << ' ' << t.x()
       << ' ' << t.y() << ' ' << t.z() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << ' '
       << q.w() << '\n';
  out << line.str();
}

std::optional<Pose> pose_at(const Trajectory& trajectory, Timestamp time) {
  const TimedPose* nearest = nearest_in_time(trajectory, time);
  return nearest ? std::optional<Pose>(nearest->world_from_camera) : std::nullopt;
}

std::optional<TrajectoryErrors> trajectory_errors(const Trajectory& estimate,
                                                  const Trajectory& truth, bool with_scale) {
  const std::vector<Pair> pairs = paired(estimate, truth);
  if (pairs.size() < 3) return std::nullopt;
  TrajectoryErrors errors;
  errors.pairs = static_cast<int>(pairs.size());
  errors.coverage = static_cast<double>(pairs.size()) / static_cast<double>(truth.size());
  errors.alignment = align(pairs, with_scale);
  double sum2 = 0;
  for (const Pair& pair : pairs) {
    const Eigen::Vector3d aligned =
        errors.alignment.truth_from_estimate *
        Eigen::Vector3d(errors.alignment.scale * pair.estimate.world_from_camera.translation());
    const double error = (aligned - pair.truth.world_from_camera.translation()).norm();
    sum2 += error * error;
    errors.ate_max = std::max(errors.ate_max, error);
  }
  errors.ate_rmse = std::sqrt(sum2 / static_cast<double>(pairs.size()));
  const RelativeErrors frame = relative_errors(pairs, 1, errors.alignment.scale);
  const RelativeErrors second = relative_errors(pairs, 999'000'000, errors.alignment.scale);
  errors.rpe_frame_translation = frame.translation;
  errors.rpe_frame_rotation = frame.rotation;
  errors.rpe_second_translation = second.translation;
  errors.rpe_second_rotation = second.rotation;
  return errors;
}

}  // namespace armsreach
