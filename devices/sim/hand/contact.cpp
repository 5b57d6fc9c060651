#include "devices/sim/hand/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

namespace armsreach::sim {
namespace {

constexpr int kIterations = 60;
constexpr double kStep = 1e-5;                         // rad, of numeric derivatives
constexpr double kApart = 1e-3;                        // m: weighs like one of the others
constexpr double kFacing = 0.7;                        // of the outward directions' sum
constexpr double kEase = 25 * std::numbers::pi / 180;  // rad away from the prior
constexpr double kDamping = 1e-4;

std::vector<Eigen::Index> angles_of(Finger finger) {
  if (finger == Finger::thumb)
    return {thumb_radial, thumb_palmar, thumb_twist, thumb_mcp, thumb_ip};
  std::vector<Eigen::Index> angles;
  for (const FingerAngle angle :
       {FingerAngle::spread, FingerAngle::mcp, FingerAngle::pip, FingerAngle::dip})
    angles.push_back(angle_index(finger, angle));
  return angles;
}

std::vector<Eigen::Index> moving_angles(std::span<const Contact> contacts) {
  std::vector<Eigen::Index> all;
  for (const Contact& contact : contacts) {
    for (const Finger finger : {contact.a.finger, contact.b.finger}) {
      const auto some = angles_of(finger);
      all.insert(all.end(), some.begin(), some.end());
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Eigen::VectorXd residuals(const HandAnatomy& anatomy, const HandPose& pose, const HandPose& prior,
                          std::span<const Contact> contacts,
                          const std::vector<Eigen::Index>& angles) {
  const HandSkeleton skeleton = skeleton_of(anatomy, pose);
  Eigen::VectorXd all(static_cast<Eigen::Index>(6 * contacts.size() + angles.size()));
  Eigen::Index row = 0;
  for (const Contact& contact : contacts) {
    const SkinPoint a = skin_point(anatomy, skeleton, contact.a);
    const SkinPoint b = skin_point(anatomy, skeleton, contact.b);
    all.segment<3>(row) = (a.position - b.position) / kApart;
    all.segment<3>(row + 3) = kFacing * (a.outwards + b.outwards);
    row += 6;
  }
  for (const Eigen::Index angle : angles) all[row++] = (pose[angle] - prior[angle]) / kEase;
  return all;
}

}  // namespace

SkinPoint skin_point(const HandAnatomy& anatomy, const HandSkeleton& skeleton,
                     const SkinPlace& place) {
  const bool thumb = place.finger == Finger::thumb;
  const FingerAnatomy* finger =
      thumb ? nullptr : &anatomy.fingers[static_cast<std::size_t>(place.finger) - 1];
  // The thumb's measures begin with its metacarpal, the others' after it.
  const std::size_t i = static_cast<std::size_t>(thumb ? place.part : place.part - 1);
  const auto& lengths = thumb ? anatomy.thumb.lengths : finger->lengths;
  const auto& radii = thumb ? anatomy.thumb.radii : finger->radii;
  const double radius = radii[i] + place.along * (radii[i + 1] - radii[i]);
  const Eigen::Vector3d side = place.side.normalized();
  const Pose& bone = skeleton[joint_of(place.finger, place.part)];
  const Eigen::Vector3d centre(0, place.along * lengths[i], 0);
  return {bone * Eigen::Vector3d(centre + radius * side), bone.rotation() * side};
}

// Levenberg's damped Gauss-Newton steps with numeric derivatives.
HandPose touching(const HandAnatomy& anatomy, const HandPose& prior,
                  std::span<const Contact> contacts) {
  const std::vector<Eigen::Index> angles = moving_angles(contacts);
  HandPose pose = within_limits(prior);
  Eigen::VectorXd now = residuals(anatomy, pose, prior, contacts, angles);
  double damping = kDamping;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::MatrixXd by_angle(now.size(), static_cast<Eigen::Index>(angles.size()));
    for (std::size_t k = 0; k < angles.size(); ++k) {
      HandPose stepped = pose;
      stepped[angles[k]] += kStep;
      by_angle.col(static_cast<Eigen::Index>(k)) =
          (residuals(anatomy, stepped, prior, contacts, angles) - now) / kStep;
    }
    Eigen::MatrixXd normal = by_angle.transpose() * by_angle;
    normal.diagonal() *= 1 + damping;
    const Eigen::VectorXd step = normal.ldlt().solve(by_angle.transpose() * now);
    HandPose moved = pose;
    for (std::size_t k = 0; k < angles.size(); ++k)
      moved[angles[k]] -= step[static_cast<Eigen::Index>(k)];
    moved = within_limits(moved);
    const Eigen::VectorXd then = residuals(anatomy, moved, prior, contacts, angles);
    if (then.squaredNorm() < now.squaredNorm()) {
      pose = moved;
      now = then;
      damping = std::max(0.3 * damping, 1e-9);
    } else {
      damping *= 5;
    }
  }
  return pose;
}

}  // namespace armsreach::sim
