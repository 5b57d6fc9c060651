#include "devices/sim/hand/hand_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace armsreach::sim {
namespace {

using Eigen::Vector3f;
using Affine = Eigen::Matrix<float, 3, 4>;

// A lobe that is farther than this, and than it melts, from a vertex at rest leaves it alone for
// good: all but some tenths of a millimetre in the deepest folds.
constexpr float kReach = 0.0125F;
// Two bones share a vertex when their lobes are equally near up to this.
constexpr float kShared = 0.007F;
constexpr float kRigidArm = 0.05F;     // m behind the wrist, from where the arm is one bone
constexpr float kSleeveHem = 0.07F;    // m behind the wrist
constexpr float kSleeveGap = 0.0065F;  // m over the skin
constexpr float kOffSkin = 0.3F * kSleeveGap;

std::vector<float> steps(float from, float to, float step) {
  std::vector<float> planes;
  for (float at = from; at < to + step; at += step) planes.push_back(at);
  return planes;
}

// Fine where the hand is, coarse along the arm.
GridPlanes planes_around(const HandAnatomy& anatomy, const HandSurfaceOptions& options) {
  const float cell = static_cast<float>(options.cell);
  const float size = static_cast<float>(anatomy.length() / mean_anatomy().length());
  const float wide = static_cast<float>(std::max(anatomy.breadth, anatomy.length() / 0.187));
  const float arm = static_cast<float>(anatomy.forearm_radius) * 1.35F + 0.012F;
  GridPlanes planes;
  planes[0] = steps(-std::max(0.092F * wide, arm), std::max(0.112F * wide, arm), cell);
  planes[2] = steps(-std::max(0.03F * wide, arm), std::max(0.062F * wide, arm), cell);
  const float from = options.sleeve ? -kSleeveHem - 0.01F : -0.03F;
  const double elbow = 1.1 * anatomy.forearm_length + 1.3 * anatomy.forearm_radius;
  // Two of the coarsest steps stay free behind it.
  float y = -static_cast<float>(std::min(options.forearm, elbow)) - 7 * cell;
  while (y < 0.205F * size) {
    planes[1].push_back(y);
    const float coarse = std::clamp((from - y) / 0.06F, 0.0F, 1.0F);
    y += cell * (1 + 2.5F * coarse);
  }
  return planes;
}

bool near_nail(const HandAnatomy& anatomy, const HandSkeleton& skeleton, const Vector3f& point) {
  for (const Finger finger :
       {Finger::thumb, Finger::index, Finger::middle, Finger::ring, Finger::little}) {
    const bool thumb = finger == Finger::thumb;
    const std::size_t i = static_cast<std::size_t>(finger) - (thumb ? 0 : 1);
    const double length = thumb ? anatomy.thumb.lengths[2] : anatomy.fingers[i].lengths[2];
    const Pose& bone = skeleton[joint_of(finger, thumb ? 2 : 3)];
    const Eigen::Vector3d p = bone.inverse() * Eigen::Vector3d(point.cast<double>());
    if (p.y() > 0.42 * length && p.y() < 1.1 * length && p.z() < 0 && p.norm() < 1.2 * length)
      return true;
  }
  return false;
}

Affine affine(const Pose& pose) { return pose.matrix().topRows<3>().cast<float>(); }

const Pose& pose_of(const HandSkeleton& skeleton, Bone bone) {
  return bone == kForearmBone ? skeleton.hand_from_forearm : skeleton.hand_from_joint[bone];
}

}  // namespace

// The flesh at rest, cut off behind, with what is worn over it.
struct HandSurface::Clothing {
  const PosedFlesh& flesh;
  const HandSurfaceOptions& options;

  float bare(const Vector3f& p) const {
    return std::max(flesh.sample(p).distance, -p.y() - static_cast<float>(options.forearm));
  }
  // Cloth with a few soft folds around the arm.
  float cloth(const Vector3f& p, float skin) const {
    const float folds = 0.0016F * std::sin(90 * p.y() + 2 * std::sin(40 * p.x()) + 25 * p.z());
    const float over = skin - kSleeveGap - folds;
    const float hem = p.y() + kSleeveHem;
    return std::max(0.8F * over, hem);
  }
  float distance(const Vector3f& p) const {
    const float skin = flesh.sample(p).distance;
    const float arm = options.sleeve ? std::min(skin, cloth(p, skin)) : skin;
    return std::max(arm, -p.y() - static_cast<float>(options.forearm));
  }
  bool sleeve(const Vector3f& p) const {
    // Whatever stands off the flesh is cloth, the hem's rim too, wherever the net has put it.
    return options.sleeve && flesh.sample(p).distance > kOffSkin;
  }
  // Where skin ends at the cloth, within `reach` along the arm.
  bool hem(const Vector3f& p, float reach) const {
    return options.sleeve && std::abs(p.y() + kSleeveHem) < reach &&
           flesh.sample(p).distance < kOffSkin + 0.5F * reach;
  }
};

HandPose HandSurface::rest_pose() {
  constexpr double kDegree = std::numbers::pi / 180;
  HandPose pose = HandPose::Zero();
  pose[thumb_radial] = 55 * kDegree;
  pose[thumb_palmar] = 22 * kDegree;
  pose[thumb_twist] = 25 * kDegree;
  constexpr std::array kSpread{14.0, 2.0, -11.0, -26.0};
  for (const Finger finger : kFingers) {
    pose[angle_index(finger, FingerAngle::spread)] =
        kSpread[static_cast<std::size_t>(finger) - 1] * kDegree;
  }
  return pose;
}

HandSurface::HandSurface(const HandAnatomy& anatomy, const HandSurfaceOptions& options)
    : anatomy_(anatomy), lobes_(flesh_of(anatomy)) {
  const HandSkeleton skeleton = skeleton_of(anatomy, rest_pose());
  for (Bone bone = 0; bone < kBoneCount; ++bone)
    bone_from_rest_[bone] = affine(pose_of(skeleton, bone).inverse());
  const PosedFlesh flesh(lobes_, skeleton);
  const Clothing clothing{flesh, options};
  rest_ = surface_net(planes_around(anatomy, options),
                      [&clothing](const Vector3f& p) { return clothing.distance(p); });
  settle(clothing);
  bindings_.reserve(rest_.vertices.size());
  for (const Vector3f& vertex : rest_.vertices)
    bindings_.push_back(bound(vertex, lobes_, flesh, clothing));
}

// Evens the net's vertices out along the surface and brings them onto it.
void HandSurface::settle(const Clothing& clothing) {
  std::vector<Vector3f>& vertices = rest_.vertices;
  const auto gradient = [&clothing](const Vector3f& p) {
    constexpr float kStep = 2e-4F;
    Vector3f g;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3f step = kStep * Vector3f::Unit(axis);
      g[axis] = clothing.distance(p + step) - clothing.distance(p - step);
    }
    return Vector3f(g / (2 * kStep));
  };
  const auto onto_surface = [&](const Vector3f& p) {
    const Vector3f g = gradient(p);
    return Vector3f(p - clothing.distance(p) / std::max(g.squaredNorm(), 0.25F) * g);
  };
  for (int round = 0; round < 3; ++round) {
    std::vector<Vector3f> sums(vertices.size(), Vector3f::Zero());
    std::vector<float> counts(vertices.size(), 0);
    for (const auto& triangle : rest_.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        sums[triangle[i]] += vertices[triangle[(i + 1) % 3]];
        counts[triangle[i]] += 1;
      }
    }
    for (std::size_t i = 0; i < vertices.size(); ++i)
      vertices[i] = onto_surface(0.5F * (vertices[i] + sums[i] / counts[i]));
  }
  // Nails are finer than the rest.
  const HandSkeleton skeleton = skeleton_of(anatomy_, rest_pose());
  rest_ = refined(rest_, [&](const Vector3f& p) { return near_nail(anatomy_, skeleton, p); });
  // Each triangle there has corners of both colours: they must not be seen as teeth.
  for (const float reach : {0.005F, 0.003F})
    rest_ = refined(rest_, [&](const Vector3f& p) { return clothing.hem(p, reach); });
  rest_normals_.reserve(vertices.size());
  for (Vector3f& vertex : vertices) {
    vertex = onto_surface(vertex);
    rest_normals_.push_back(gradient(vertex).normalized());
  }
}

HandSurface::Binding HandSurface::bound(const Vector3f& point, const std::vector<Lobe>& lobes,
                                        const PosedFlesh& flesh, const Clothing& clothing) {
  Binding binding;
  binding.sleeve = clothing.sleeve(point);
  if (binding.sleeve || point.y() < -kRigidArm) {
    binding.bones.fill(static_cast<std::uint8_t>(kForearmBone));
    binding.weights[0] = 1;
    return binding;
  }
  std::vector<float> distances(lobes.size());
  std::vector<float> alongs(lobes.size());
  for (std::size_t i = 0; i < lobes.size(); ++i)
    distances[i] = flesh.sample_one(i, point, &alongs[i]).distance;
  const float nearest = *std::min_element(distances.begin(), distances.end());
  std::array<float, kBoneCount> shares{};
  binding.first_lobe = static_cast<std::uint32_t>(near_lobes_.size());
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    if (distances[i] < nearest + std::max(kReach, lobes[i].melt))
      near_lobes_.push_back(static_cast<std::uint16_t>(i));
    const float closeness = std::max(0.0F, 1 - (distances[i] - nearest) / kShared);
    const float weight = closeness * closeness;
    shares[lobes[i].bone_a] += (1 - alongs[i]) * weight;
    shares[lobes[i].bone_b] += alongs[i] * weight;
  }
  binding.lobe_count = static_cast<std::uint32_t>(near_lobes_.size()) - binding.first_lobe;
  // Where the arm is cut off flat there is no flesh's surface to be drawn to.
  if (std::abs(clothing.bare(point) - flesh.sample(point).distance) > 2e-4F) binding.lobe_count = 0;
  float sum = 0;
  for (std::size_t k = 0; k < kBones; ++k) {
    const auto most = std::max_element(shares.begin(), shares.end());
    binding.bones[k] = static_cast<std::uint8_t>(most - shares.begin());
    binding.weights[k] = std::exchange(*most, 0.0F);
    sum += binding.weights[k];
  }
  for (float& weight : binding.weights) weight /= sum;
  return binding;
}

// Bones carry each vertex to about its place (linear blend skinning, which loses volume at bent
// joints); two steps along the posed flesh's gradient bring it onto the surface again.
void HandSurface::pose(const HandSkeleton& skeleton, PosedSurface& out) const {
  std::array<Affine, kBoneCount> posed_from_rest;
  for (Bone bone = 0; bone < kBoneCount; ++bone) {
    const Affine posed = affine(pose_of(skeleton, bone));
    posed_from_rest[bone].leftCols<3>() = posed.leftCols<3>() * bone_from_rest_[bone].leftCols<3>();
    posed_from_rest[bone].col(3) =
        posed.leftCols<3>() * bone_from_rest_[bone].col(3) + posed.col(3);
  }
  const PosedFlesh flesh(lobes_, skeleton);
  out.positions.resize(rest_.vertices.size());
  out.normals.resize(rest_.vertices.size());
  for (std::size_t i = 0; i < rest_.vertices.size(); ++i) {
    const Binding& binding = bindings_[i];
    Affine carry = binding.weights[0] * posed_from_rest[binding.bones[0]];
    for (std::size_t k = 1; k < kBones && binding.weights[k] > 0; ++k)
      carry += binding.weights[k] * posed_from_rest[binding.bones[k]];
    Vector3f position = carry.leftCols<3>() * rest_.vertices[i] + carry.col(3);
    Vector3f normal = carry.leftCols<3>() * rest_normals_[i];
    if (binding.lobe_count > 0) {
      const std::span<const std::uint16_t> near(near_lobes_.data() + binding.first_lobe,
                                                binding.lobe_count);
      for (int step = 0; step < 2; ++step) {
        const FieldSample sample = flesh.sample(near, position);
        const float slope = std::max(sample.outwards.squaredNorm(), 0.25F);
        position -= sample.distance / slope * sample.outwards;
        normal = sample.outwards;
      }
    }
    out.positions[i] = position;
    out.normals[i] = normal.normalized();
  }
}

}  // namespace armsreach::sim
