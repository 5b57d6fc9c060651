// The hand before an infra-red camera: its surface by what covers it, and what it wears.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "devices/sim/hand/hand_actor.hpp"
#include "devices/sim/hand/hand_surface.hpp"
#include "devices/sim/infrared/infrared_description.hpp"
#include "devices/sim/infrared/worn.hpp"

namespace armsreach::sim {

enum class Cover : std::size_t { skin, glove, sleeve };
inline constexpr std::size_t kCoverCount = 3;

class InfraredHand {
 public:
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;

  // A right hand whose script is in the world's frame.
  InfraredHand(const HandDescription& hand, const InfraredDescription& infrared);

  // At one instant, in the hand's frame.
  struct Moment {
    Pose world_from_hand;
    PosedSurface surface;
    Worn worn;
    HandSkeleton skeleton;
    HandTruth truth;
  };
  Moment at(double time) const;

  const HandSurface& surface() const { return surface_; }
  const Triangles& triangles(Cover cover) const {
    return triangles_[static_cast<std::size_t>(cover)];
  }

 private:
  HandActor actor_;
  HandSurface surface_;
  std::optional<BraceletDescription> bracelet_;
  std::optional<GloveDescription> glove_;
  std::array<Triangles, kCoverCount> triangles_;
};

}  // namespace armsreach::sim
