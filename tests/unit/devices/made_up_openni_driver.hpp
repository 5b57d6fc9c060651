// What the made-up OpenNI2 sensor delivers.
#pragma once

#include <cstdint>

namespace armsreach::test {

constexpr const char* kMadeUpUri = "made-up://1";
constexpr int kMadeUpWidth = 160;
constexpr int kMadeUpHeight = 120;
constexpr float kMadeUpFieldOfView = 1.0F;  // rad
constexpr float kMadeUpVerticalFieldOfView = 0.8F;
constexpr int kMadeUpPeriod = 33'333;     // us
constexpr int kMadeUpColorDelay = 7'000;  // us, of colour after depth

// Millimetres at a pixel of the image `number`; the top row is unknown. Registration moves it.
inline std::uint16_t made_up_depth(int x, int y, int number, bool registered) {
  return y == 0 ? std::uint16_t{0}
                : static_cast<std::uint16_t>(500 + x + number % 1000 + (registered ? 3000 : 0));
}

// Green is x and blue is y.
inline std::uint8_t made_up_red(int number) { return static_cast<std::uint8_t>(number % 251); }

}  // namespace armsreach::test

// Of the module, for dlsym: plugs the sensor in or out, as seen by the library's listeners.
using MadeUpSensorPlug = void (*)(bool in);
