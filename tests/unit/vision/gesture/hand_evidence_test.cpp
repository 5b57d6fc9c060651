#include "vision/gesture/hand_evidence.hpp"

#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

constexpr HandEvidence kClearHand{0.96, 0.03, 0.2, 0.05};

TEST(HandEvidence, AClearHandIsLikely) { EXPECT_GT(log_odds(kClearHand), 1); }

TEST(HandEvidence, EachSignAgainstAHandCounts) {
  HandEvidence unlike = kClearHand, close = kClearHand, wall = kClearHand, cluttered = kClearHand;
  unlike.likeness = 0.85;
  close.margin = 0.001;
  wall.contact = 1.2;
  cluttered.clutter = 0.6;
  for (const HandEvidence& worse : {unlike, close, wall, cluttered})
    EXPECT_LT(log_odds(worse), log_odds(kClearHand) - 1);
}

TEST(HandEvidence, OneGestureAloneProvesNoHand) {
  // Where a single gesture is known, nothing is near it; that must not make a wall a hand.
  EXPECT_LT(log_odds({0.88, 1, 1.2, 0.6}), 0);
}

}  // namespace
}  // namespace armsreach::gesture
