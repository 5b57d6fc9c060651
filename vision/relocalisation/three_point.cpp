#include "vision/relocalisation/three_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Cholesky>
#include <opencv2/calib3d.hpp>

namespace armsreach::relocalisation {
namespace {

using Triple = std::array<int, 3>;

// The error of one sighting in units of its tolerance, squared; depth is left out where unknown.
double squared_error(const Sighting& sighting, const Pose& camera_from_world,
                     double ray_tolerance) {
  const Eigen::Vector3d point = camera_from_world * sighting.point_in_world;
  if (point.z() <= 0) return std::numeric_limits<double>::infinity();
  double squared =
      (point.head<2>() / point.z() - sighting.ray).squaredNorm() / (ray_tolerance * ray_tolerance);
  if (std::isfinite(sighting.depth)) {
    const double off = (point.z() - sighting.depth) / depth_tolerance(sighting.depth);
    squared = std::max(squared, off * off);
  }
  return squared;
}

// Of a pose: the number of sightings that agree, those that barely do counting little (MSAC).
double score(const std::vector<Sighting>& sightings, const Pose& camera_from_world,
             double ray_tolerance) {
  double sum = 0;
  for (const Sighting& sighting : sightings) {
    sum += std::max(0.0, 1 - squared_error(sighting, camera_from_world, ray_tolerance));
  }
  return sum;
}

// Whether the sides of the triangle are as long in the camera as in the world, as far as depth
// tells, and long enough to fix a pose.
bool congruent(const std::vector<Sighting>& sightings, const Triple& triple) {
  constexpr double kShortest = 0.05;  // m
  for (int side = 0; side < 3; ++side) {
    const Sighting& a = sightings[triple[side]];
    const Sighting& b = sightings[triple[(side + 1) % 3]];
    const double in_world = (a.point_in_world - b.point_in_world).norm();
    if (in_world < kShortest) return false;
    const double in_camera = (a.depth * a.ray.homogeneous() - b.depth * b.ray.homogeneous()).norm();
    if (!std::isfinite(in_camera)) continue;
    if (std::abs(in_world - in_camera) > depth_tolerance(std::max(a.depth, b.depth))) return false;
  }
  return true;
}

std::vector<Pose> poses_of(const std::vector<Sighting>& sightings, const Triple& triple) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> rays;
  for (const int i : triple) {
    const Eigen::Vector3d& point = sightings[i].point_in_world;
    points.emplace_back(point.x(), point.y(), point.z());
    rays.emplace_back(sightings[i].ray.x(), sightings[i].ray.y());
  }
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::solveP3P(points, rays, cv::Matx33d::eye(), cv::noArray(), rotations, translations,
               cv::SOLVEPNP_P3P);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const cv::Vec3d r = rotations[i];
    const cv::Vec3d t = translations[i];
    const Pose pose(so3_exp({r[0], r[1], r[2]}), {t[0], t[1], t[2]});
    if (pose.is_finite()) poses.push_back(pose);
  }
  return poses;
}

// Draws that miss every triple of inliers with a probability of 1 %, at this share of inliers.
double draws_needed(double inlier_share) {
  const double all_three = std::clamp(inlier_share * inlier_share * inlier_share, 1e-9, 1 - 1e-9);
  return std::log(0.01) / std::log(1 - all_three);
}

}  // namespace

double depth_tolerance(double depth) { return 0.02 + 0.01 * depth * depth; }

std::vector<int> agreeing(const std::vector<Sighting>& sightings, const Pose& camera_from_world,
                          double ray_tolerance) {
  std::vector<int> inliers;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (squared_error(sightings[i], camera_from_world, ray_tolerance) < 1)
      inliers.push_back(static_cast<int>(i));
  }
  return inliers;
}

Pose refined_pose(const Pose& camera_from_world, const std::vector<Sighting>& sightings,
                  const std::vector<int>& chosen, double ray_tolerance) {
  constexpr int kIterations = 10;
  constexpr double kConverged = 1e-7;  // m and rad
  // A tolerance is about three standard deviations; beyond one the pull no longer grows.
  const double ray_sigma = ray_tolerance / 3;
  Pose pose = camera_from_world;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Matrix6d information = 1e-9 * Matrix6d::Identity();
    Vector6d pull = Vector6d::Zero();
    for (const int i : chosen) {
      const Sighting& sighting = sightings[i];
      const Eigen::Vector3d point = pose * sighting.point_in_world;
      if (point.z() <= 0) continue;
      Eigen::Matrix<double, 3, 6> point_by_tangent;  // exp(tangent) * pose
      point_by_tangent << Eigen::Matrix3d::Identity(), -skew(point);
      const Eigen::Vector2d ray = point.head<2>() / point.z();
      Eigen::Matrix<double, 3, 3> by_point;
      by_point << 1 / point.z(), 0, -ray.x() / point.z(), 0, 1 / point.z(), -ray.y() / point.z(), 0,
          0, 0;
      Eigen::Vector3d residual;
      residual << ray - sighting.ray, 0;
      residual /= ray_sigma;
      by_point /= ray_sigma;
      if (std::isfinite(sighting.depth)) {
        const double depth_sigma = depth_tolerance(sighting.depth) / 3;
        residual.z() = (point.z() - sighting.depth) / depth_sigma;
        by_point(2, 2) = 1 / depth_sigma;
      }
      const double weight = 1 / std::max(1.0, residual.norm());
      const Eigen::Matrix<double, 3, 6> jacobian = by_point * point_by_tangent;
      information += weight * jacobian.transpose() * jacobian;
      pull -= weight * jacobian.transpose() * residual;
    }
    const Vector6d step = information.ldlt().solve(pull);
    if (!step.allFinite()) break;
    pose = Pose::exp(step) * pose;
    if (step.norm() < kConverged) break;
  }
  return pose;
}

std::optional<ThreePointFit> three_point_pose(const std::vector<Sighting>& sightings,
                                              const ThreePointOptions& options) {
  constexpr int kFewest = 4;  // three agree by construction
  const int count = static_cast<int>(sightings.size());
  if (count < kFewest) return std::nullopt;
  std::mt19937_64 random(options.seed);
  Pose best;
  double best_score = 0;
  double needed = options.most_samples;
  int poses_tried = 0;
  for (int sample = 0; sample < needed && poses_tried < options.most_poses; ++sample) {
    Triple triple;
    for (int& i : triple) i = static_cast<int>(random() % static_cast<std::uint64_t>(count));
    if (triple[0] == triple[1] || triple[1] == triple[2] || triple[2] == triple[0]) continue;
    if (!congruent(sightings, triple)) continue;
    ++poses_tried;
    for (const Pose& pose : poses_of(sightings, triple)) {
      const double found = score(sightings, pose, options.ray_tolerance);
      if (found <= best_score) continue;
      best_score = found;
      best = pose;
      needed = std::min(needed, draws_needed(found / count));
    }
  }
  // Twice: what the refined pose agrees with refines it again.
  for (int round = 0; round < 2; ++round) {
    const std::vector<int> inliers = agreeing(sightings, best, options.ray_tolerance);
    if (static_cast<int>(inliers.size()) < kFewest) return std::nullopt;
    best = refined_pose(best, sightings, inliers, options.ray_tolerance);
  }
  ThreePointFit fit{best, agreeing(sightings, best, options.ray_tolerance)};
  if (static_cast<int>(fit.inliers.size()) < kFewest) return std::nullopt;
  return fit;
}

}  // namespace armsreach::relocalisation
