#include "vision/gesture/hand_evidence.hpp"

#include <algorithm>

namespace armsreach::gesture {
namespace {

// Logistic regression on photographs of five people's gestures and on rooms without hands; each
// person and room judged by what the others taught. Each is scaled by about its spread.
constexpr double kLikenessScale = 0.03, kLikenessMiddle = 0.93, kLikenessWeight = 0.83;
constexpr double kMarginScale = 0.012, kMarginMiddle = 0.015, kMarginWeight = 1.20;
constexpr double kContactScale = 0.35, kContactMiddle = 0.4, kContactWeight = -1.36;
constexpr double kClutterScale = 0.2, kClutterMiddle = 0.3, kClutterWeight = -1.07;
constexpr double kConstant = 0.32;
constexpr double kMostMargin = 0.04;  // one gesture known, or one like no other, proves no hand

}  // namespace

double log_odds(const HandEvidence& evidence) {
  const double margin = std::min(evidence.margin, kMostMargin);
  return kConstant + kLikenessWeight * (evidence.likeness - kLikenessMiddle) / kLikenessScale +
         kMarginWeight * (margin - kMarginMiddle) / kMarginScale +
         kContactWeight * (evidence.contact - kContactMiddle) / kContactScale +
         kClutterWeight * (evidence.clutter - kClutterMiddle) / kClutterScale;
}

}  // namespace armsreach::gesture
