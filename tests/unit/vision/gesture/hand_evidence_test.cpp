#include "vision/gesture/hand_evidence.hpp"

#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

HandEvidence hand() {
  HandEvidence evidence;
  evidence.likeness = 0.95;
  evidence.margin = 0.02;
  evidence.contact = 0.4;
  evidence.solidity = 0.8;
  evidence.texture = 1;
  return evidence;
}

TEST(HandEvidence, AHandIsTold) { EXPECT_GT(log_odds(hand()), 0); }

TEST(HandEvidence, EachSignOfAnotherThingCounts) {
  const auto without = [](auto change) {
    HandEvidence other = hand();
    change(other);
    return log_odds(other);
  };
  const double told = log_odds(hand());
  EXPECT_LT(without([](auto& e) { e.likeness = 0.9; }), told);
  EXPECT_LT(without([](auto& e) { e.margin = 0.002; }), told);
  EXPECT_LT(without([](auto& e) { e.contact = 1.2; }), told);
  EXPECT_LT(without([](auto& e) { e.solidity = 0.95; }), told);
  EXPECT_LT(without([](auto& e) { e.share = 0.01; }), told);
  EXPECT_LT(without([](auto& e) { e.texture = -1; }), told);
  EXPECT_LT(without([](auto& e) { e.plain = true; }), told);
  EXPECT_LT(without([](auto& e) { e.parted = true; }), told);
}

// A hand held close is no more of a hand.
TEST(HandEvidence, SizeCountsUpToThatOfAHandWithinReach) {
  HandEvidence near = hand(), nearer = hand();
  near.share = 0.1;
  nearer.share = 0.3;
  EXPECT_EQ(log_odds(near), log_odds(nearer));
}

// With one gesture known there is no other to be less like, and a margin of nothing is finite.
TEST(HandEvidence, MarginsProveSoMuchAndNoMore) {
  HandEvidence far = hand(), farther = hand(), none = hand();
  far.margin = 0.05;
  farther.margin = 1;
  none.margin = 0;
  EXPECT_EQ(log_odds(far), log_odds(farther));
  EXPECT_GT(log_odds(none), log_odds(hand()) - 5);
}

}  // namespace
}  // namespace armsreach::gesture
