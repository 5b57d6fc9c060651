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
// Information beside what noise feigns. A blank wall seen by a noisy sensor has 0.2 to 0.5, rooms
// have 7 to 150 with depth and from 2 with intensity alone.
constexpr double kLeastObservability = 1.5;

double surprise(double scale, double usual, double always_fine) {
  return scale / std::max(usual, always_fine);
}

}  // namespace

bool Verdict::trusts(const AlignmentResult& alignment, int pixels) const {
  if (!alignment.ok || alignment.compared < kLeastCompared * pixels ||
      alignment.inliers < kLeastInliers * alignment.compared) {
    return false;
  }
  if (alignment.scales.depth > kNeverFine.depth ||
      alignment.scales.intensity > kNeverFine.intensity) {
    return false;
  }
  return alignment.observability > kLeastObservability &&
         (learnt_ == 0 || relative_rms(alignment) <= kSurprise);
}

double Verdict::relative_rms(const AlignmentResult& alignment) const {
  const double depth = surprise(alignment.scales.depth, usual_.depth, kAlwaysFine.depth);
  const double intensity =
      surprise(alignment.scales.intensity, usual_.intensity, kAlwaysFine.intensity);
  return std::sqrt(alpha_ * depth * depth + (1 - alpha_) * intensity * intensity);
}

void Verdict::learn(const AlignmentResult& alignment) {
  learnt_ = std::min(learnt_ + 1, kMemory);
  usual_.depth += (alignment.scales.depth - usual_.depth) / learnt_;
  usual_.intensity += (alignment.scales.intensity - usual_.intensity) / learnt_;
}

}  // namespace armsreach
