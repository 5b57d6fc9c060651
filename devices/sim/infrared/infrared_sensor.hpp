// What a monochrome global-shutter sensor behind a small lens makes of the light that the lens
// receives.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "devices/sim/noise_tile.hpp"
#include "vision/core/camera.hpp"

namespace armsreach::sim {

class InfraredSensor {
 public:
  // `noise`: in units of the usual.
  InfraredSensor(const Camera& camera, double noise, std::uint64_t seed);

  // `light`: CV_32F in grey levels, without bound. Returns CV_8U. The corners get less light; a
  // point's light spreads over its neighbours and, a few percent of it, as a glow around bright
  // things; what is more than white saturates.
  cv::Mat measure(const cv::Mat& light, std::int64_t frame) const;

 private:
  double noise_scale_;
  NoiseTile noise_;
  cv::Mat vignetting_;         // CV_32F
  std::vector<float> column_;  // each column's amplifier has its own offset, grey levels
};

}  // namespace armsreach::sim
