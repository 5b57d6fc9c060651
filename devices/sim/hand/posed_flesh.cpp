#include <algorithm>
#include <cmath>

#include "devices/sim/hand/flesh.hpp"

namespace armsreach::sim {

using Eigen::Vector3f;

PosedFlesh::PosedFlesh(const std::vector<Lobe>& lobes, const HandSkeleton& skeleton) {
  const auto placed = [&skeleton](Bone bone, const Vector3f& point) {
    const Pose& pose =
        bone == kForearmBone ? skeleton.hand_from_forearm : skeleton.hand_from_joint[bone];
    return Vector3f((pose * point.cast<double>()).cast<float>());
  };
  cones_.reserve(lobes.size());
  for (const Lobe& lobe : lobes) {
    const Vector3f a = placed(lobe.bone_a, lobe.in_a);
    const Vector3f b = placed(lobe.bone_b, lobe.in_b);
    const float length = std::max((b - a).norm(), 1e-6F);
    const float slope = std::clamp((lobe.radius_a - lobe.radius_b) / length, -0.98F, 0.98F);
    cones_.push_back({a, (b - a) / length, length, lobe.radius_a, slope,
                      slope / std::sqrt(1 - slope * slope), lobe.melt, 0.5F * (a + b),
                      0.5F * length + std::max(lobe.radius_a, lobe.radius_b)});
  }
}

// The hull is the union of balls from one end to the other. A ball at t along the axis is
// hypot(off, at - t) - (radius - slope t) away, which is convex in t and least at t = at - lean
// off.
FieldSample PosedFlesh::sample_one(std::size_t lobe, const Vector3f& point, float* along) const {
  const Cone& cone = cones_[lobe];
  const Vector3f from_start = point - cone.start;
  const float at = cone.axis.dot(from_start);
  const float off = std::sqrt(std::max(from_start.squaredNorm() - at * at, 0.0F));
  const float t = std::clamp(at - cone.lean * off, 0.0F, cone.length);
  const Vector3f from_centre = from_start - t * cone.axis;
  const float reach = std::max(from_centre.norm(), 1e-9F);
  if (along) *along = t / cone.length;
  return {reach - cone.radius + cone.slope * t, from_centre / reach};
}

// Two surfaces melt as min(a, b) - (m - |a - b|)^2 / 4m where they are less than m apart.
void PosedFlesh::melt_in(std::size_t lobe, const Vector3f& point, FieldSample& sum) const {
  const FieldSample one = sample_one(lobe, point, nullptr);
  const float melt = cones_[lobe].melt;
  const float apart = one.distance - sum.distance;
  if (apart >= melt) return;
  if (apart <= -melt) {
    sum = one;
    return;
  }
  const float share = 0.5F * (1 - apart / melt);  // of the new one
  sum.distance = share * one.distance + (1 - share) * sum.distance - melt * share * (1 - share);
  sum.outwards = share * one.outwards + (1 - share) * sum.outwards;
}

FieldSample PosedFlesh::sample(std::span<const std::uint16_t> lobes, const Vector3f& point) const {
  FieldSample sum{1, Vector3f::Zero()};
  for (const std::uint16_t lobe : lobes) melt_in(lobe, point, sum);
  return sum;
}

FieldSample PosedFlesh::sample(const Vector3f& point) const {
  FieldSample sum{1, Vector3f::Zero()};
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const Cone& cone = cones_[i];
    const float away = std::max(sum.distance + cone.melt + cone.reach, 0.0F);
    if ((point - cone.middle).squaredNorm() < away * away) melt_in(i, point, sum);
  }
  return sum;
}

}  // namespace armsreach::sim
