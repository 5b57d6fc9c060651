// The most frequent gesture of the last frames.
#include "vision/gesture/modal_filter.hpp"

#include <gtest/gtest.h>

namespace armsreach::gesture {
namespace {

constexpr Timestamp kFrame = 33'333'333;

TEST(ModalFilter, AFrameToldWronglyIsNotNoticed) {
  ModalFilter filter(0.25);
  Timestamp time = 0;
  for (const char* name : {"point", "point", "point", "fist", "", "point"}) {
    EXPECT_EQ(filter.update(name, 0.9, time += kFrame).name, "point");
  }
}

TEST(ModalFilter, AChangeIsNoticedOnceItIsTheMajorityOfTheWindow) {
  ModalFilter filter(0.25);
  Timestamp time = 0;
  for (int i = 0; i < 20; ++i) filter.update("point", 0.9, time += kFrame);
  int frames = 0;
  while (filter.update("L", 0.8, time += kFrame).name != "L") ++frames;
  EXPECT_EQ(frames, 4);  // 8 frames in the window: the fifth outweighs three
  EXPECT_DOUBLE_EQ(filter.mode().score, 0.8);
  EXPECT_DOUBLE_EQ(filter.mode().share, 5.0 / 8);
}

TEST(ModalFilter, TheWindowIsTimeNotFrames) {
  ModalFilter filter(0.25);
  for (int i = 0; i < 20; ++i) filter.update("point", 0.9, i * kFrame);
  EXPECT_EQ(filter.update("L", 0.8, 30 * kFrame).name, "L");  // all before are too old
}

TEST(ModalFilter, OfEqualsTheOldModeStays) {
  ModalFilter filter(1);
  filter.update("open", 0.9, 0);
  EXPECT_EQ(filter.update("fist", 0.9, kFrame).name, "open");
}

}  // namespace
}  // namespace armsreach::gesture
