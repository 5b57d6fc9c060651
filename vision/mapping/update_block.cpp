// Chooses between the builds of update_block_kernel.cpp for the processor at hand. They give the
// same bits: both are plain IEEE operations in the same order.
#include "vision/mapping/update_block.hpp"

namespace armsreach::mapping {

#ifdef ARMSREACH_KERNEL_AVX2
namespace avx2 {
std::uint64_t cubes_in_reach(const float (&origin)[3], const FrameEvidence& frame);
std::uint64_t update_cubes(const Block& block, const float (&origin)[3], std::uint64_t cubes,
                           const FrameEvidence& frame, BlockCubes& updated);
}  // namespace avx2
static bool has_avx2() {
  static const bool has = __builtin_cpu_supports("avx2");
  return has;
}
#endif
namespace baseline {
std::uint64_t cubes_in_reach(const float (&origin)[3], const FrameEvidence& frame);
std::uint64_t update_cubes(const Block& block, const float (&origin)[3], std::uint64_t cubes,
                           const FrameEvidence& frame, BlockCubes& updated);
}  // namespace baseline

std::uint64_t cubes_in_reach(const float (&origin)[3], const FrameEvidence& frame) {
#ifdef ARMSREACH_KERNEL_AVX2
  if (has_avx2()) return avx2::cubes_in_reach(origin, frame);
#endif
  return baseline::cubes_in_reach(origin, frame);
}

std::uint64_t update_cubes(const Block& block, const float (&origin)[3], std::uint64_t cubes,
                           const FrameEvidence& frame, BlockCubes& updated) {
#ifdef ARMSREACH_KERNEL_AVX2
  if (has_avx2()) return avx2::update_cubes(block, origin, cubes, frame, updated);
#endif
  return baseline::update_cubes(block, origin, cubes, frame, updated);
}

}  // namespace armsreach::mapping
