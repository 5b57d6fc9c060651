// Vectors of the processor's own width, for files compiled with armsreach_isa_levels(). A loop over
// blocks of kBlock elements that keeps kBlock running sums gives the same bits at every level.
//
// Everything here is static and always inlined: a function with external linkage would exist once in
// the program, compiled for whichever level the linker happened to keep. For the same reason such
// files use no templates of the standard library.
#pragma once

#include <cstdint>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace armsreach::lanes {

#if defined(__AVX512F__)
constexpr int kWidth = 16;
#elif defined(__AVX2__)
constexpr int kWidth = 8;
#else
constexpr int kWidth = 4;
#endif
constexpr int kBlock = 16;

using Float [[gnu::vector_size(4 * kWidth)]] = float;
using Int [[gnu::vector_size(4 * kWidth)]] = std::int32_t;

#define ARMSREACH_INLINE [[gnu::always_inline]] static inline

ARMSREACH_INLINE Float load(const float* p) {
  Float v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
ARMSREACH_INLINE void store(float* p, Float v) { __builtin_memcpy(p, &v, sizeof v); }
ARMSREACH_INLINE Float all(float x) { return x - Float{}; }
ARMSREACH_INLINE Int all(std::int32_t x) { return x - Int{}; }
ARMSREACH_INLINE Float counting() {  // 0, 1, 2, ...
  Float v;
  for (int i = 0; i < kWidth; ++i) v[i] = static_cast<float>(i);
  return v;
}
ARMSREACH_INLINE Float abs(Float x) {
  return reinterpret_cast<Float>(reinterpret_cast<Int>(x) & 0x7fffffff);
}
ARMSREACH_INLINE Float min(Float a, Float b) { return a < b ? a : b; }  // b where a is NaN
ARMSREACH_INLINE Float max(Float a, Float b) { return a > b ? a : b; }

// base[index]
ARMSREACH_INLINE Float gather(const float* base, Int index) {
#if defined(__AVX512F__)
  return reinterpret_cast<Float>(_mm512_i32gather_ps(reinterpret_cast<__m512i>(index), base, 4));
#elif defined(__AVX2__)
  return reinterpret_cast<Float>(_mm256_i32gather_ps(base, reinterpret_cast<__m256i>(index), 4));
#else
  Float v;
  for (int i = 0; i < kWidth; ++i) v[i] = base[index[i]];
  return v;
#endif
}

}  // namespace armsreach::lanes
