// Chooses between the builds of update_block_kernel.cpp for the processor at hand. They give the
// same bits: both are plain IEEE operations in the same order.
#include "vision/mapping/update_block.hpp"

namespace armsreach::mapping {

#ifdef ARMSREACH_KERNEL_AVX2
namespace avx2 {
bool update_block(Block& block, const float (&origin)[3], const DepthIntervals& depths,
                  const FrameEvidence& frame);
}
#endif
namespace baseline {
bool update_block(Block& block, const float (&origin)[3], const DepthIntervals& depths,
                  const FrameEvidence& frame);
}

bool update_block(Block& block, const float (&origin)[3], const DepthIntervals& depths,
                  const FrameEvidence& frame) {
#ifdef ARMSREACH_KERNEL_AVX2
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  if (has_avx2) return avx2::update_block(block, origin, depths, frame);
#endif
  return baseline::update_block(block, origin, depths, frame);
}

}  // namespace armsreach::mapping
