#include "vision/alignment/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach {
namespace {

constexpr double kLeastCompared = 0.1;  // of all pixels
constexpr double kLeastInliers = 0.5;   // of those compared
constexpr double kSurprise = 4;         // times the usual residual
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

bool Verdict::trusts(const AlignmentResult& alignment, int pixels) const {
  const ResidualScales& scales = alignment.scales;
  const ResidualScales suspicious{kSurprise * std::max(usual_.depth, kAlwaysFine.depth),
                                  kSurprise * std::max(usual_.intensity, kAlwaysFine.intensity)};
  return alignment.ok && alignment.compared >= kLeastCompared * pixels &&
         alignment.inliers >= kLeastInliers * alignment.compared &&
         alignment.observability > kLeastObservability && scales.depth < kNeverFine.depth &&
         scales.intensity < kNeverFine.intensity &&
         (learnt_ == 0 || rms(scales, suspicious, alpha_) <= 1);
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
