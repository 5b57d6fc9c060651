// Made-up recordings in the layout of fakenect, which plays them through libfreenect's interface:
// INDEX.txt names, in order, one file an image, TYPE-SECONDS-TICKS.EXT with a line of header before
// the driver's raw bytes.
#pragma once

#include <cstdint>
#include <filesystem>

namespace armsreach::test {

constexpr std::uint32_t kTicksPerFrame = 2'000'000;  // of the Kinect's 60 MHz clock: 33 ms

// Frame i holds kinect_number(x, y, i) as depth and red = i, green = x, blue = y modulo 256;
// colour is taken 5 ms after depth. Played three times as fast as a Kinect. The clock starts a
// second before it wraps.
void write_kinect_session(const std::filesystem::path& folder, int frames);

// 11 bits: a plane tilted along x, further away with i; the top row is unknown.
inline std::uint16_t kinect_number(int x, int y, int i) {
  return y == 0 ? std::uint16_t{2047} : static_cast<std::uint16_t>(500 + x / 2 + i);
}

}  // namespace armsreach::test
