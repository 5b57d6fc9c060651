// Vectors of the processor's own width, for files compiled with armsreach_isa_levels(). A loop over
// blocks of kBlock elements that keeps kBlock running sums gives the same bits at every level.
//
// Everything here is static and always inlined: a function with external linkage would exist once
// in the program, compiled for whichever level the linker happened to keep. For the same reason
// such files use no templates of the standard library.
//
// Choose with chains of `condition ? a : b`: GCC 12 takes conjunctions of conditions apart bit by
// bit at AVX-512.
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

// Elements 0, 2, 4, ... and 1, 3, 5, ... of a followed by b.
ARMSREACH_INLINE Float even(Float a, Float b) {
#if defined(__AVX512F__)
  return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
#elif defined(__AVX2__)
  return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
#else
  return __builtin_shufflevector(a, b, 0, 2, 4, 6);
#endif
}
ARMSREACH_INLINE Float odd(Float a, Float b) {
#if defined(__AVX512F__)
  return __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
#elif defined(__AVX2__)
  return __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
#else
  return __builtin_shufflevector(a, b, 1, 3, 5, 7);
#endif
}

struct Pair {
  Float first, second;
};
// base[index] and base[index + 1]
ARMSREACH_INLINE Pair gather_pair(const float* base, Int index) {
#if defined(__AVX512F__)
  const auto low = _mm512_castsi512_si256(reinterpret_cast<__m512i>(index));
  const auto high = _mm512_extracti64x4_epi64(reinterpret_cast<__m512i>(index), 1);
  const auto a = reinterpret_cast<Float>(_mm512_i32gather_pd(low, base, 4));
  const auto b = reinterpret_cast<Float>(_mm512_i32gather_pd(high, base, 4));
#elif defined(__AVX2__)
  const auto* pairs = reinterpret_cast<const double*>(base);
  const auto low = _mm256_castsi256_si128(reinterpret_cast<__m256i>(index));
  const auto high = _mm256_extracti128_si256(reinterpret_cast<__m256i>(index), 1);
  const auto a = reinterpret_cast<Float>(_mm256_i32gather_pd(pairs, low, 4));
  const auto b = reinterpret_cast<Float>(_mm256_i32gather_pd(pairs, high, 4));
#else
  Float a, b;
  for (int i = 0; i < 2; ++i) {
    __builtin_memcpy(reinterpret_cast<char*>(&a) + 8 * i, base + index[i], 8);
    __builtin_memcpy(reinterpret_cast<char*>(&b) + 8 * i, base + index[i + 2], 8);
  }
#endif
  return {even(a, b), odd(a, b)};
}

}  // namespace armsreach::lanes
