#include "devices/sim/hand/arm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// Upper arm to forearm, shoulder to elbow to wrist. Source: Winter, "Biomechanics and motor control
// of human movement", 4th edition, fig. 4.1.
constexpr double kUpperToFore = 0.186 / 0.146;
constexpr double kStretched = 0.97;  // share of the bones' sum at which a reaching arm ends
constexpr double kHangs = 0.45;      // how much an elbow hangs, against keeping the wrist straight
constexpr float kSleeveOverSkin = 0.0065F;  // m, as on the forearm

// From the wrist to the elbow, unit length, in the hand's frame (see
// HandSkeleton::hand_from_forearm).
Vector3d behind_wrist(double flexion, double deviation) {
  return {std::sin(deviation) * std::cos(flexion), -std::cos(deviation) * std::cos(flexion),
          std::sin(flexion)};
}

// Where an elbow at the wished side of the circle is that both bones allow; wrist in the origin.
Vector3d elbow_on_circle(const Vector3d& shoulder, double fore, double upper,
                         const Vector3d& wished) {
  const double far = shoulder.norm();
  const Vector3d axis = shoulder / far;
  const double along = (fore * fore - upper * upper + far * far) / (2 * far);
  const double radius = std::sqrt(std::max(0.0, fore * fore - along * along));
  const Vector3d side = wished - wished.dot(axis) * axis;
  return along * axis + radius * side.normalized();
}

}  // namespace

double forearm_bone(const HandAnatomy& anatomy) { return 1.1 * anatomy.forearm_length; }
double upper_arm_bone(const HandAnatomy& anatomy) { return kUpperToFore * anatomy.forearm_length; }

Arm arm_to_shoulder(const HandAnatomy& anatomy, const HandPose& scripted, const Vector3d& shoulder,
                    const Vector3d& down) {
  const double fore = forearm_bone(anatomy);
  const double upper = upper_arm_bone(anatomy);
  const double far = std::clamp(shoulder.norm(), 1.02 * std::abs(fore - upper) + 0.05,
                                kStretched * (fore + upper));
  Arm arm;
  arm.shoulder = shoulder;
  const Vector3d straight = behind_wrist(scripted[wrist_flexion], scripted[wrist_deviation]);
  const Vector3d elbow =
      elbow_on_circle(far * shoulder.normalized(), fore, upper, straight + kHangs * down);
  const Vector3d direction = elbow.normalized();
  HandPose pose = scripted;
  pose[wrist_flexion] = std::asin(std::clamp(direction.z(), -1.0, 1.0));
  pose[wrist_deviation] = std::atan2(direction.x(), -direction.y());
  pose = within_limits(pose);
  arm.wrist_flexion = pose[wrist_flexion];
  arm.wrist_deviation = pose[wrist_deviation];
  arm.elbow = fore * behind_wrist(arm.wrist_flexion, arm.wrist_deviation);
  return arm;
}

// Rings along a line whose ends are half balls.
UpperArm::UpperArm(const HandAnatomy& anatomy, bool sleeve)
    : length_(static_cast<float>(upper_arm_bone(anatomy))) {
  constexpr int kAround = 28;
  constexpr int kCap = 6;
  constexpr int kAlong = 14;
  constexpr float kHalfTurn = std::numbers::pi_v<float>;
  const float over = sleeve ? kSleeveOverSkin : 0;
  const float thin = 0.98F * static_cast<float>(anatomy.forearm_radius) + over;
  const float thick = 1.3F * static_cast<float>(anatomy.forearm_radius) + over;
  struct Ring {
    float y, radius, lean;  // lean: the normal's share along y
  };
  std::vector<Ring> rings;
  for (int i = 0; i <= kCap; ++i) {
    const float angle = -kHalfTurn / 2 * (1 - static_cast<float>(i) / kCap);
    rings.push_back({thin * std::sin(angle), thin * std::cos(angle), std::sin(angle)});
  }
  for (int i = 1; i < kAlong; ++i) {
    const float share = static_cast<float>(i) / kAlong;
    // Biceps and triceps stand out a little halfway.
    const float swell = 1 + 0.06F * std::sin(kHalfTurn * share);
    rings.push_back({share * length_, swell * (thin + share * (thick - thin)), 0});
  }
  for (int i = 0; i <= kCap; ++i) {
    const float angle = kHalfTurn / 2 * static_cast<float>(i) / kCap;
    rings.push_back({length_ + thick * std::sin(angle), thick * std::cos(angle), std::sin(angle)});
  }
  for (const Ring& ring : rings) {
    for (int k = 0; k < kAround; ++k) {
      const float turn = 2 * kHalfTurn * static_cast<float>(k) / kAround;
      const Vector3f out(std::cos(turn), 0, std::sin(turn));
      rest_.vertices.push_back(ring.radius * out + ring.y * Vector3f::UnitY());
      normals_.push_back(std::sqrt(1 - ring.lean * ring.lean) * out +
                         ring.lean * Vector3f::UnitY());
    }
  }
  const auto index = [](std::size_t ring, int k) {
    return static_cast<std::uint32_t>(ring * kAround + static_cast<std::size_t>(k % kAround));
  };
  for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
    for (int k = 0; k < kAround; ++k) {
      rest_.triangles.push_back({index(ring, k), index(ring + 1, k), index(ring + 1, k + 1)});
      rest_.triangles.push_back({index(ring, k), index(ring + 1, k + 1), index(ring, k + 1)});
    }
  }
}

void UpperArm::pose(const Arm& arm, PosedSurface& out) const {
  const Vector3d bone = arm.shoulder - arm.elbow;
  const float stretch = static_cast<float>(bone.norm()) / length_;
  const Eigen::Matrix3f turn =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitY(), bone).toRotationMatrix().cast<float>();
  const Vector3f elbow = arm.elbow.cast<float>();
  out.positions.resize(rest_.vertices.size());
  out.normals.resize(rest_.vertices.size());
  for (std::size_t i = 0; i < rest_.vertices.size(); ++i) {
    Vector3f point = rest_.vertices[i];
    // Its rounded ends stay round.
    const float along = std::clamp(point.y(), 0.0F, length_);
    point.y() += (stretch - 1) * along;
    out.positions[i] = turn * point + elbow;
    out.normals[i] = turn * normals_[i];
  }
}

}  // namespace armsreach::sim
