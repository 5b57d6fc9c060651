// Where the ring detector looks: concentric rings around a hand's centroid.
// Source: Mayol, Davison, Tordoff, Molton, Murray, "Interaction between hand and wearable camera in
// 2D and 3D environments", BMVC 2004, section 2.2.
#pragma once

#include <cstdint>
#include <vector>

namespace armsreach::gesture {

inline constexpr int kMostRings = 16;
inline constexpr int kMostSamples = 256;  // on a ring
inline constexpr int kMostWeight = 63;    // four of them fit in a byte

struct RingLayout {
  std::vector<float> radii;           // in units of the square root of the hand's area, rising
  std::vector<std::uint8_t> weights;  // of a ring's samples in g, 1..63
  int samples = 0;                    // on each ring, even: the paper's 2 K

  int rings() const { return static_cast<int>(radii.size()); }
  double step() const;  // rad between samples
  int total_weight() const;
  bool valid() const;
  bool operator==(const RingLayout&) const = default;
};

// Five rings, radii doubling, all samples alike. [paper]
RingLayout doubling_rings(int k = 90);

// Twelve rings at equal distances; weights are proportional to radii, so that each stands for the
// area around it.
RingLayout linear_rings(int k = 45);

// Sixteen, closer to each other, for hands that differ by little: which finger meets the thumb.
RingLayout fine_rings(int k = 45);

}  // namespace armsreach::gesture
