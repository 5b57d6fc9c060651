#include "vision/gesture/hand_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::gesture {
namespace {

// Logistic regression on photographs of five people's gestures and on rooms without hands; each
// person and room judged by what the others taught. Each is scaled by about its spread.
constexpr double kConstant = -0.22;
constexpr double kLikenessScale = 0.03, kLikenessMiddle = 0.93, kLikenessWeight = 1.33;
constexpr double kMarginMiddle = 0.01, kMarginWeight = 0.73;  // of its logarithm
constexpr double kContactScale = 0.35, kContactMiddle = 0.4, kContactWeight = -0.52;
constexpr double kSolidityScale = 0.1, kSolidityMiddle = 0.85, kSolidityWeight = -0.69;
constexpr double kPlainWeight = -1.25, kPartedWeight = -0.42;
constexpr double kEnoughShare = 0.06, kShareWeight = 1.51;  // of its logarithm, below that
constexpr double kTextureWeight = 0.56;
// One gesture known, or one like no other, proves no hand; and least differences are chance.
constexpr double kLeastMargin = 0.001, kMostMargin = 0.04;
constexpr double kLeastShare = 1e-4;

}  // namespace

double log_odds(const HandEvidence& evidence) {
  const double margin = std::clamp(evidence.margin, kLeastMargin, kMostMargin);
  const double share = std::max(evidence.share, kLeastShare);
  return kConstant + kLikenessWeight * (evidence.likeness - kLikenessMiddle) / kLikenessScale +
         kMarginWeight * std::log(margin / kMarginMiddle) +
         kContactWeight * (evidence.contact - kContactMiddle) / kContactScale +
         kSolidityWeight * (evidence.solidity - kSolidityMiddle) / kSolidityScale +
         kPlainWeight * (evidence.plain ? 0.7 : -0.3) +
         kShareWeight * std::min(0.0, std::log(share / kEnoughShare)) +
         kPartedWeight * (evidence.parted ? 1 : 0) + kTextureWeight * evidence.texture;
}

}  // namespace armsreach::gesture
