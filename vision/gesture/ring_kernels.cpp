// Weighted popcount: a table look-up gives four bits' weight at once (Mula, Kurz, Lemire, "Faster
// Population Counts Using AVX2 Instructions", 2018, with weights in place of counts).
#include "vision/gesture/ring_kernels.hpp"

#if defined(__SSSE3__)
#include <immintrin.h>
#endif

namespace armsreach::gesture::ARMSREACH_ISA {
namespace {

#define ARMSREACH_INLINE [[gnu::always_inline]] static inline

#if defined(__AVX512BW__)
constexpr int kBytes = 64;
using Bytes = __m512i;
ARMSREACH_INLINE Bytes load(const std::uint8_t* p) { return _mm512_loadu_si512(p); }
ARMSREACH_INLINE Bytes table(const std::uint8_t* p) {
  return _mm512_broadcast_i32x4(_mm_load_si128(reinterpret_cast<const __m128i*>(p)));
}
ARMSREACH_INLINE Bytes zero() { return _mm512_setzero_si512(); }
ARMSREACH_INLINE Bytes differ(Bytes a, Bytes b, Bytes inside) {
  return _mm512_and_si512(_mm512_xor_si512(a, b), inside);
}
ARMSREACH_INLINE Bytes weigh(Bytes bits, Bytes low, Bytes high) {
  const Bytes half = _mm512_set1_epi8(15);
  return _mm512_add_epi64(
      _mm512_sad_epu8(_mm512_shuffle_epi8(low, _mm512_and_si512(bits, half)), zero()),
      _mm512_sad_epu8(_mm512_shuffle_epi8(high, _mm512_and_si512(_mm512_srli_epi16(bits, 4), half)),
                      zero()));
}
ARMSREACH_INLINE Bytes add(Bytes a, Bytes b) { return _mm512_add_epi64(a, b); }
ARMSREACH_INLINE std::uint32_t total(Bytes a) {
  return static_cast<std::uint32_t>(_mm512_reduce_add_epi64(a));
}
#elif defined(__AVX2__)
constexpr int kBytes = 32;
using Bytes = __m256i;
ARMSREACH_INLINE Bytes load(const std::uint8_t* p) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
}
ARMSREACH_INLINE Bytes table(const std::uint8_t* p) {
  return _mm256_broadcastsi128_si256(_mm_load_si128(reinterpret_cast<const __m128i*>(p)));
}
ARMSREACH_INLINE Bytes zero() { return _mm256_setzero_si256(); }
ARMSREACH_INLINE Bytes differ(Bytes a, Bytes b, Bytes inside) {
  return _mm256_and_si256(_mm256_xor_si256(a, b), inside);
}
ARMSREACH_INLINE Bytes weigh(Bytes bits, Bytes low, Bytes high) {
  const Bytes half = _mm256_set1_epi8(15);
  return _mm256_add_epi64(
      _mm256_sad_epu8(_mm256_shuffle_epi8(low, _mm256_and_si256(bits, half)), zero()),
      _mm256_sad_epu8(_mm256_shuffle_epi8(high, _mm256_and_si256(_mm256_srli_epi16(bits, 4), half)),
                      zero()));
}
ARMSREACH_INLINE Bytes add(Bytes a, Bytes b) { return _mm256_add_epi64(a, b); }
ARMSREACH_INLINE std::uint32_t total(Bytes a) {
  const __m128i sum = _mm_add_epi64(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1));
  return static_cast<std::uint32_t>(_mm_extract_epi64(sum, 0) + _mm_extract_epi64(sum, 1));
}
#elif defined(__SSSE3__)
constexpr int kBytes = 16;
using Bytes = __m128i;
ARMSREACH_INLINE Bytes load(const std::uint8_t* p) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
}
ARMSREACH_INLINE Bytes table(const std::uint8_t* p) { return load(p); }
ARMSREACH_INLINE Bytes zero() { return _mm_setzero_si128(); }
ARMSREACH_INLINE Bytes differ(Bytes a, Bytes b, Bytes inside) {
  return _mm_and_si128(_mm_xor_si128(a, b), inside);
}
ARMSREACH_INLINE Bytes weigh(Bytes bits, Bytes low, Bytes high) {
  const Bytes half = _mm_set1_epi8(15);
  return _mm_add_epi64(
      _mm_sad_epu8(_mm_shuffle_epi8(low, _mm_and_si128(bits, half)), zero()),
      _mm_sad_epu8(_mm_shuffle_epi8(high, _mm_and_si128(_mm_srli_epi16(bits, 4), half)), zero()));
}
ARMSREACH_INLINE Bytes add(Bytes a, Bytes b) { return _mm_add_epi64(a, b); }
ARMSREACH_INLINE std::uint32_t total(Bytes a) {
  return static_cast<std::uint32_t>(_mm_cvtsi128_si64(a) +
                                    _mm_cvtsi128_si64(_mm_unpackhi_epi64(a, a)));
}
#else  // one byte at a time
constexpr int kBytes = 1;
using Bytes = std::uint32_t;
struct Table {
  const std::uint8_t* weights;
};
ARMSREACH_INLINE Bytes load(const std::uint8_t* p) { return *p; }
ARMSREACH_INLINE Table table(const std::uint8_t* p) { return {p}; }
ARMSREACH_INLINE Bytes zero() { return 0; }
ARMSREACH_INLINE Bytes differ(Bytes a, Bytes b, Bytes inside) { return (a ^ b) & inside; }
ARMSREACH_INLINE Bytes weigh(Bytes bits, Table low, Table high) {
  return low.weights[bits & 15U] + high.weights[bits >> 4U];
}
ARMSREACH_INLINE Bytes add(Bytes a, Bytes b) { return a + b; }
ARMSREACH_INLINE std::uint32_t total(Bytes a) { return a; }
#endif

void mismatches(const TurnedSignature& seen, const std::uint8_t* known, int first, int step,
                int count, std::uint32_t* sums) {
  const auto low_0 = table(seen.weights[0][0]);
  const auto high_0 = table(seen.weights[0][1]);
  const auto low_1 = table(seen.weights[1][0]);
  const auto high_1 = table(seen.weights[1][1]);
  for (int i = 0; i < count; ++i) {
    const int from = first + i * step;
    Bytes sum = zero();
    for (int at = 0; at < seen.samples; at += kBytes) {
      const Bytes inside = load(seen.inside + at);
      const Bytes in_0 = differ(load(seen.planes[0] + from + at), load(known + at), inside);
      const Bytes in_1 =
          differ(load(seen.planes[1] + from + at), load(known + kMostSamples + at), inside);
      sum = add(sum, add(weigh(in_0, low_0, high_0), weigh(in_1, low_1, high_1)));
    }
    sums[i] = total(sum);
  }
}

}  // namespace

extern const RingKernels kRingKernels{mismatches};

}  // namespace armsreach::gesture::ARMSREACH_ISA
