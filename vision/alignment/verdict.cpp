#include "vision/alignment/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach {
namespace {

constexpr double kLeastInliers = 0.5;  // of the pixels compared
// Below these no residual is suspicious, above the others none is depth or a picture: k z^2 of the
// best depth cameras and of none, one grey level and a third of the range.
constexpr ResidualScales kAlwaysFine{1e-3, 4e-3};
constexpr ResidualScales kNeverFine{5e-2, 0.3};
constexpr int kMemory = 30;  // frames over which the usual residuals are averaged
// Information beside what noise feigns: 0.5 to 1 on blank walls, from 4 in rooms.
constexpr double kLeastObservability = 2;

// Of both residuals, each beside `level`.
double rms(const ResidualScales& scales, const ResidualScales& level, double alpha) {
  const double depth = scales.depth / level.depth;
  const double intensity = scales.intensity / level.intensity;
  return std::sqrt(alpha * depth * depth + (1 - alpha) * intensity * intensity);
}

}  // namespace

// Beside no usual residuals a found pose is compared with four times a Kinect's at 80x60; at poses
// half a metre off, depth often fits as well, but intensity leaves 0.09 and more.
const Verdict::Demands Verdict::kFollowed{0.1, 4, kNeverFine};
const Verdict::Demands Verdict::kFound{0.3, 2.5, {8e-3, 0.08}};

bool Verdict::meets(const Demands& demands, const AlignmentResult& alignment, int pixels) {
  const ResidualScales& scales = alignment.scales;
  return alignment.ok && alignment.compared >= demands.overlap * pixels &&
         alignment.inliers >= kLeastInliers * alignment.compared &&
         alignment.observability > kLeastObservability && scales.depth < kNeverFine.depth &&
         scales.intensity < kNeverFine.intensity;
}

bool Verdict::trusts(const AlignmentResult& alignment, int pixels) const {
  return meets(kFollowed, alignment, pixels) &&
         rms(alignment.scales, suspicious(kFollowed), alignment.alpha) <= 1;
}

bool Verdict::confirms(const AlignmentResult& alignment, int pixels) const {
  const ResidualScales limit = suspicious(kFound);
  return meets(kFound, alignment, pixels) && alignment.scales.depth <= limit.depth &&
         alignment.scales.intensity <= limit.intensity;
}

ResidualScales Verdict::suspicious(const Demands& demands) const {
  const auto limit = [&](const Usual& usual, double always_fine, double unknown) {
    return usual.frames > 0 ? demands.surprise * std::max(usual.scale, always_fine) : unknown;
  };
  return {limit(depth_, kAlwaysFine.depth, demands.unknown.depth),
          limit(intensity_, kAlwaysFine.intensity, demands.unknown.intensity)};
}

double Verdict::relative_rms(const AlignmentResult& alignment) const {
  const auto usual = [](const Usual& learnt, double now) {
    return learnt.frames > 0 ? learnt.scale : std::max(now, 1e-9);
  };
  const ResidualScales& now = alignment.scales;
  const ResidualScales level{usual(depth_, now.depth), usual(intensity_, now.intensity)};
  return alignment.ok ? rms(now, level, alignment.alpha) : 0;
}

void Verdict::learn(const AlignmentResult& alignment) {
  const auto learn_one = [](double scale, Usual& usual) {
    if (!(scale > 0)) return;  // not compared
    usual.frames = std::min(usual.frames + 1, kMemory);
    usual.scale += (scale - usual.scale) / usual.frames;
  };
  learn_one(alignment.scales.depth, depth_);
  learn_one(alignment.scales.intensity, intensity_);
}

}  // namespace armsreach
