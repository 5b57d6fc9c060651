// The skin of one person's right hand: meshed once, then carried along by the bones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/hand/anatomy.hpp"
#include "devices/sim/hand/flesh.hpp"
#include "devices/sim/hand/skeleton.hpp"
#include "devices/sim/hand/surface_net.hpp"

namespace armsreach::sim {

struct HandSurfaceOptions {
  double forearm = 1;    // m of arm behind the wrist, cut off flat; the elbow is at about 0.3
  bool sleeve = false;   // over the arm from 7 cm behind the wrist on
  double cell = 0.0035;  // m, about the length of a triangle's side
};

inline constexpr float kGloveHem = -0.02F;  // m along the arm, where a glove ends

// A surface in one posture, in the (right) hand's frame.
struct PosedSurface {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;  // unit, outwards
};

class HandSurface {
 public:
  HandSurface(const HandAnatomy& anatomy, const HandSurfaceOptions& options);

  const HandAnatomy& anatomy() const { return anatomy_; }
  // The posture in which it was meshed: all fingers spread. Vertex i stays vertex i in any other.
  static HandPose rest_pose();
  const TriangleMesh& rest() const { return rest_; }
  const std::vector<Eigen::Vector3f>& rest_normals() const { return rest_normals_; }
  bool is_sleeve(std::size_t vertex) const { return bindings_[vertex].sleeve; }
  // The bone that carries a vertex most.
  Bone bone_of(std::size_t vertex) const { return bindings_[vertex].bones[0]; }

  // `out` keeps its memory from call to call.
  void pose(const HandSkeleton& skeleton, PosedSurface& out) const;

 private:
  static constexpr std::size_t kBones = 4;
  struct Binding {
    std::array<std::uint8_t, kBones> bones{};
    std::array<float, kBones> weights{};  // sum to 1, falling
    std::uint32_t first_lobe = 0;         // in near_lobes_
    std::uint32_t lobe_count = 0;         // 0: it is not drawn to the flesh
    bool sleeve = false;
  };
  struct Clothing;

  Binding bound(const Eigen::Vector3f& point, const std::vector<Lobe>& lobes,
                const PosedFlesh& flesh, const Clothing& clothing);
  void settle(const Clothing& clothing);

  HandAnatomy anatomy_;
  std::vector<Lobe> lobes_;
  TriangleMesh rest_;
  std::vector<Eigen::Vector3f> rest_normals_;
  std::array<Eigen::Matrix<float, 3, 4>, kBoneCount> bone_from_rest_;
  std::vector<Binding> bindings_;
  std::vector<std::uint16_t> near_lobes_;
};

}  // namespace armsreach::sim
