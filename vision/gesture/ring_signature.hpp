// What the rings see of a hand: one bit a sample, set on the hand.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/gesture/ring_layout.hpp"

namespace armsreach::gesture {

// The samples of all rings at one angle are neighbouring bits, so that turning a signature is
// moving it in memory: byte [ring / 8][angle], bit ring % 8. Angles run clockwise in the image from
// the x axis. Bytes beyond the layout's samples are zero.
struct RingSignature {
  static constexpr int kPlanes = kMostRings / 8;
  std::array<std::array<std::uint8_t, kMostSamples>, kPlanes> planes{};

  bool at(int ring, int angle) const { return (planes[ring / 8][angle] >> (ring % 8)) & 1; }
  void set(int ring, int angle) {
    planes[ring / 8][angle] |= static_cast<std::uint8_t>(1 << (ring % 8));
  }
  bool operator==(const RingSignature&) const = default;
};

// `mask`: CV_8UC1, not 0 on the hand; beyond it there is none. `center` in its pixels, `area` in
// px^2; `turn` [rad] is added to every sample's angle.
RingSignature sample_rings(const cv::Mat& mask, const Eigen::Vector2d& center, double area,
                           const RingLayout& layout, double turn = 0);

// As the hand is seen in a mirror: image x goes the other way.
RingSignature mirrored(const RingSignature& signature, const RingLayout& layout);

// g of the definition: the weighted mean of products of samples in {+1, -1}, `seen` at angle
// i + shift against `known` at angle i. 1 is the same, -1 the opposite.
double similarity(const RingSignature& seen, const RingSignature& known, int shift,
                  const RingLayout& layout);

}  // namespace armsreach::gesture
