// What covers the bones: lobes, each the hull of two balls that hang on bones, melted together.
// The hand's surface is where their common distance is zero.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/hand/anatomy.hpp"
#include "devices/sim/hand/skeleton.hpp"

namespace armsreach::sim {

// Bones are numbered like the joints where they begin; the forearm comes after them.
using Bone = std::size_t;
inline constexpr Bone kForearmBone = kHandJointCount;
inline constexpr std::size_t kBoneCount = kHandJointCount + 1;

struct Lobe {
  Bone bone_a = 0;
  Bone bone_b = 0;
  Eigen::Vector3f in_a{0, 0, 0};  // centre of one ball in bone_a's frame
  Eigen::Vector3f in_b{0, 0, 0};  // of the other in bone_b's
  float radius_a = 0;
  float radius_b = 0;
  float melt = 0;  // m: how near another surface it begins to melt with it
};

// Of a right hand, with its forearm to beyond the elbow.
std::vector<Lobe> flesh_of(const HandAnatomy& anatomy);

struct FieldSample {
  float distance = 0;                 // m, negative inside
  Eigen::Vector3f outwards{0, 0, 0};  // its gradient; about unit length
};

// The flesh on a posed skeleton.
class PosedFlesh {
 public:
  PosedFlesh(const std::vector<Lobe>& lobes, const HandSkeleton& skeleton);

  std::size_t size() const { return cones_.size(); }
  // To one lobe's own surface; `along` receives where it is nearest, 0 at a .. 1 at b.
  FieldSample sample_one(std::size_t lobe, const Eigen::Vector3f& point, float* along) const;
  // To the surface of those lobes melted in their order.
  FieldSample sample(std::span<const std::uint16_t> lobes, const Eigen::Vector3f& point) const;
  // To the surface of all.
  FieldSample sample(const Eigen::Vector3f& point) const;

 private:
  struct Cone {
    Eigen::Vector3f start;
    Eigen::Vector3f axis;  // unit
    float length;
    float radius;  // at the start
    float slope;   // radius lost per length, below 1
    float lean;    // slope over the root of 1 - slope^2
    float melt;
    Eigen::Vector3f middle;  // of a ball around all of it
    float reach;             // that ball's radius
  };
  void melt_in(std::size_t lobe, const Eigen::Vector3f& point, FieldSample& sum) const;
  std::vector<Cone> cones_;
};

}  // namespace armsreach::sim
