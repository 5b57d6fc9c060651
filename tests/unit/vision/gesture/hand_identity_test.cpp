// Hands keep their numbers.
#include "vision/gesture/hand_identity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

using ::testing::ElementsAre;

constexpr Timestamp kFrame = 33'333'333;

HandObservation at(double x, double y) {
  HandObservation hand;
  hand.center = {x, y};
  hand.area = 100 * 100;
  return hand;
}

TEST(HandIdentity, NumbersFollowTheHandsWhateverTheirOrder) {
  HandIdentity identity;
  EXPECT_THAT(identity.assign({at(100, 200), at(500, 200)}, 0), ElementsAre(0, 1));
  EXPECT_THAT(identity.assign({at(490, 210), at(110, 190)}, kFrame), ElementsAre(1, 0));
}

TEST(HandIdentity, HandsThatPassEachOtherKeepTheirNumbers) {
  HandIdentity identity;
  for (int i = 0; i <= 20; ++i) {
    // One goes right and the other left, 40 px apart where they meet.
    const HandObservation a = at(100 + 20.0 * i, 200);
    const HandObservation b = at(500 - 20.0 * i, 240);
    const bool swapped = i % 3 == 1;
    const auto ids =
        identity.assign(swapped ? HandObservations{b, a} : HandObservations{a, b}, i * kFrame);
    EXPECT_THAT(ids, swapped ? ElementsAre(1, 0) : ElementsAre(0, 1)) << i;
  }
}

TEST(HandIdentity, AHandThatLeavesForLongGivesItsNumberAway) {
  HandIdentity identity;
  identity.assign({at(100, 200), at(500, 200)}, 0);
  EXPECT_THAT(identity.assign({at(500, 200)}, kFrame), ElementsAre(1));
  EXPECT_THAT(identity.known(), ElementsAre(0, 1));  // remembered
  EXPECT_THAT(identity.assign({at(500, 200)}, 30 * kFrame), ElementsAre(0));
  EXPECT_THAT(identity.known(), ElementsAre(0));
}

TEST(HandIdentity, AHandFarFromWhereOneWasIsAnother) {
  HandIdentity identity;
  identity.assign({at(100, 200)}, 0);
  EXPECT_THAT(identity.assign({at(600, 200)}, kFrame), ElementsAre(1));
}

}  // namespace
}  // namespace armsreach::gesture
