#include "vision/mono_slam/start_target.hpp"

#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

namespace armsreach::mono_slam {
namespace {

// A corner's or a frontal patch's error; the residuals on the desk sequence say 0.28.
constexpr double kPointSigma = 0.3;  // px
// Beyond this the pose is so far from linear in its errors that the filter ends in a wrong one.
constexpr double kMostPositionSigma = 0.05;  // m
constexpr double kMostShift = 25;            // px between two frames

bool agree(const TargetFix& a, const TargetFix& b) {
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    if ((a.points[i].pixel - b.points[i].pixel).norm() > kMostShift) return false;
  }
  // A shift and a turn are told apart weakly from frame to frame; the distance is not.
  const double before = a.pose.world_from_camera.translation().norm();
  const double now = b.pose.world_from_camera.translation().norm();
  return std::abs(std::log(now / before)) < 0.15;
}

}  // namespace

double position_sigma(const TargetFix& fix) {
  const Eigen::Matrix3d covariance = fix.pose.covariance.topLeftCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return kPointSigma * std::sqrt(solver.eigenvalues().maxCoeff());
}

TargetSight TargetWatch::look(const cv::Mat& grey, const SearchImage& image, const Camera& camera) {
  const std::optional<TargetFix> before = std::exchange(last_, std::nullopt);
  last_ = target_.rectangle ? find_rectangle(grey, camera, *target_.rectangle)
                            : find_marks(image, camera, target_.marks);
  if (!last_) return TargetSight::nothing;
  const bool confirmed = last_->certain || (before && agree(*before, *last_));
  if (!confirmed) return TargetSight::once;
  return position_sigma(*last_) < kMostPositionSigma ? TargetSight::found : TargetSight::too_far;
}

}  // namespace armsreach::mono_slam
