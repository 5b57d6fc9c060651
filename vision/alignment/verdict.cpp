#include "vision/alignment/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach {
namespace {

constexpr double kLeastCompared = 0.1;  // of all pixels
constexpr double kLeastInliers = 0.5;   // of those compared
constexpr double kSurprise = 4;         // times the usual residual
constexpr double kLeastOverlap = 0.3;   // of all pixels, and times the usual residual, of a pose
constexpr double kStrictSurprise = 2;   // that nothing else speaks for
// Below these no residual is suspicious, above the others none is depth or a picture: k z^2 of the
// best depth cameras and of none, one grey level and a third of the range.
constexpr ResidualScales kAlwaysFine{1e-3, 4e-3};
constexpr ResidualScales kNeverFine{5e-2, 0.3};
// What is no surprise while nothing is known to be usual: four times a Kinect's at 80x60.
constexpr ResidualScales kStrict{8e-3, 0.08};
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

ResidualScales Verdict::suspicious(double surprise) const {
  return {surprise * std::max(usual_.depth, kAlwaysFine.depth),
          surprise * std::max(usual_.intensity, kAlwaysFine.intensity)};
}

bool Verdict::fits(const AlignmentResult& alignment, int pixels, double least_compared,
                   const ResidualScales& suspicious) const {
  return alignment.ok && alignment.compared >= least_compared * pixels &&
         alignment.inliers >= kLeastInliers * alignment.compared &&
         alignment.observability > kLeastObservability &&
         alignment.scales.depth < kNeverFine.depth &&
         alignment.scales.intensity < kNeverFine.intensity &&
         rms(alignment.scales, suspicious, alpha_) <= 1;
}

bool Verdict::trusts(const AlignmentResult& alignment, int pixels) const {
  return fits(alignment, pixels, kLeastCompared, learnt_ > 0 ? suspicious(kSurprise) : kNeverFine);
}

bool Verdict::confirms(const AlignmentResult& alignment, int pixels) const {
  return fits(alignment, pixels, kLeastOverlap,
              learnt_ > 0 ? suspicious(kStrictSurprise) : kStrict);
}

double Verdict::relative_rms(const AlignmentResult& alignment) const {
  return alignment.ok ? rms(alignment.scales, learnt_ > 0 ? usual_ : alignment.scales, alpha_) : 0;
}

void Verdict::learn(const AlignmentResult& alignment) {
  learnt_ = std::min(learnt_ + 1, kMemory);
  usual_.depth += (alignment.scales.depth - usual_.depth) / learnt_;
  usual_.intensity += (alignment.scales.intensity - usual_.intensity) / learnt_;
}

}  // namespace armsreach
