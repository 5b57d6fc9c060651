#include "vision/gesture/hand_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::gesture {
namespace {

// Logistic regression on photographs of eight people's gestures and on rooms without hands; each
// person and room judged by what the others taught. Each is scaled by about its spread.
constexpr double kConstant = -0.16;
constexpr double kLikenessScale = 0.03, kLikenessMiddle = 0.93, kLikenessWeight = 1.11;
constexpr double kMarginMiddle = 0.01, kMarginWeight = 0.87;  // of its logarithm
constexpr double kContactScale = 0.35, kContactMiddle = 0.4, kContactWeight = -0.59;
constexpr double kSolidityScale = 0.1, kSolidityMiddle = 0.85, kSolidityWeight = -0.57;
constexpr double kShareMiddle = 0.06, kShareWeight = 1.38;  // of its logarithm
constexpr double kArmWeight = 1.24, kPlainWeight = -2.02, kPartedWeight = -0.43;
constexpr double kWristSpread = 0.09, kWristMiddle = 0.68, kWristWeight = -0.68;
// One gesture known, or one like no other, proves no hand; and least differences are chance.
constexpr double kLeastMargin = 0.001, kMostMargin = 0.04;
constexpr double kLeastShare = 1e-4;

// How far a wrist is from the breadth that wrists have, as a normal distribution's cost with an end
// to it; and about what it is of one that is not seen.
double misfit(const std::optional<double>& wrist) {
  constexpr double kMost = 2, kUnseen = 0.5;
  if (!wrist) return kUnseen;
  const double away = (*wrist - kWristMiddle) / kWristSpread;
  return std::min(kMost, away * away / 2);
}

}  // namespace

double log_odds(const HandEvidence& evidence) {
  const double margin = std::clamp(evidence.margin, kLeastMargin, kMostMargin);
  const double share = std::max(evidence.share, kLeastShare);
  return kConstant + kLikenessWeight * (evidence.likeness - kLikenessMiddle) / kLikenessScale +
         kMarginWeight * std::log(margin / kMarginMiddle) +
         kContactWeight * (evidence.contact - kContactMiddle) / kContactScale +
         kSolidityWeight * (evidence.solidity - kSolidityMiddle) / kSolidityScale +
         kShareWeight * std::log(share / kShareMiddle) +
         kArmWeight * (evidence.wrist ? 0.5 : -0.5) + kWristWeight * misfit(evidence.wrist) +
         kPlainWeight * (evidence.plain ? 0.7 : -0.3) + kPartedWeight * (evidence.parted ? 1 : 0);
}

}  // namespace armsreach::gesture
