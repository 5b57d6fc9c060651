// The inner loop of matching signatures. Implementation detail.
#pragma once

#include <cstdint>

#include "vision/core/isa.hpp"
#include "vision/gesture/ring_layout.hpp"
#include "vision/gesture/ring_signature.hpp"

namespace armsreach::gesture {

// What is seen, twice around each plane, ready to be read from any angle on.
struct TurnedSignature {
  alignas(64) std::uint8_t planes[RingSignature::kPlanes][2 * kMostSamples + 64];
  alignas(64) std::uint8_t inside[kMostSamples];  // 255 for bytes within a ring, then 0
  // Weight of four neighbouring bits: [plane][low or high half][their value].
  alignas(16) std::uint8_t weights[RingSignature::kPlanes][2][16];
  int samples;
};

struct RingKernels {
  // Sum of the weights of the samples that differ from `known` (its planes one after the other,
  // kMostSamples apart) when what is seen is read from angle first, first + step, ... on.
  void (*mismatches)(const TurnedSignature& seen, const std::uint8_t* known, int first, int step,
                     int count, std::uint32_t* sums);
};
RingKernels ring_kernels(Isa isa);

namespace baseline {
extern const RingKernels kRingKernels;
}
namespace v3 {
extern const RingKernels kRingKernels;
}
namespace v4 {
extern const RingKernels kRingKernels;
}

}  // namespace armsreach::gesture
