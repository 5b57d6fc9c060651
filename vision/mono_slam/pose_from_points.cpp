#include "vision/mono_slam/pose_from_points.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <opencv2/calib3d.hpp>

#include "vision/mono_slam/point.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct NormalEquations {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double squares = 0;
};

std::optional<NormalEquations> linearised(const Camera& camera, const CameraState& state,
                                          const std::vector<SeenPoint>& points) {
  NormalEquations out;
  for (const SeenPoint& seen : points) {
    Point point;
    point.values = seen.point_in_world;
    const auto s = sighting(camera, state, point);
    if (!s) return std::nullopt;
    const Vector2d error = seen.pixel - s->pixel;
    const Eigen::Matrix<double, 2, kPoseRows> by_pose = s->by_camera.leftCols<kPoseRows>();
    out.hessian += by_pose.transpose() * by_pose;
    out.gradient += by_pose.transpose() * error;
    out.squares += error.squaredNorm();
  }
  return out;
}

}  // namespace

std::optional<PoseFix> refined_pose(const Camera& camera, const Pose& world_from_camera,
                                    const std::vector<SeenPoint>& points) {
  constexpr int kMostIterations = 20;
  CameraState state;
  state.position = world_from_camera.translation();
  state.rotation = world_from_camera.rotation();
  auto now = linearised(camera, state, points);
  double damping = 1e-4;
  for (int i = 0; i < kMostIterations && now; ++i) {
    Matrix6d damped = now->hessian;
    damped.diagonal() *= 1 + damping;
    CameraError step = CameraError::Zero();
    step.head<6>() = damped.ldlt().solve(now->gradient);
    if (!step.allFinite()) return std::nullopt;
    const CameraState candidate = corrected(state, step);
    const auto next = linearised(camera, candidate, points);
    if (!next || next->squares > now->squares) {
      damping *= 10;
      continue;
    }
    state = candidate;
    now = next;
    damping *= 0.1;
    if (step.norm() < 1e-9) break;
  }
  if (!now) return std::nullopt;
  const Eigen::LLT<Matrix6d> factor(now->hessian);
  if (factor.info() != Eigen::Success) return std::nullopt;
  PoseFix out;
  out.world_from_camera = state.world_from_camera();
  out.covariance = factor.solve(Matrix6d::Identity());
  out.rms = std::sqrt(now->squares / static_cast<double>(points.size()));
  return out;
}

std::vector<Pose> three_point_poses(const Camera& camera, const std::vector<SeenPoint>& points) {
  CV_Assert(points.size() == 3);
  std::vector<cv::Point3d> objects;
  std::vector<cv::Point2d> rays;
  for (const SeenPoint& seen : points) {
    const Vector3d& p = seen.point_in_world;
    const Vector3d ray = unproject(camera, seen.pixel);
    objects.emplace_back(p.x(), p.y(), p.z());
    rays.emplace_back(ray.x(), ray.y());
  }
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::solveP3P(objects, rays, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotations, translations,
               cv::SOLVEPNP_AP3P);
  std::vector<Pose> out;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const auto* const r = rotations[i].ptr<double>();
    const auto* const t = translations[i].ptr<double>();
    const Pose pose(so3_exp(Vector3d(r[0], r[1], r[2])), Vector3d(t[0], t[1], t[2]));
    if (pose.is_finite()) out.push_back(pose.inverse());
  }
  return out;
}

}  // namespace armsreach::mono_slam
