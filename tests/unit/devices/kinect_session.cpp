#include "tests/unit/devices/kinect_session.hpp"

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace armsreach::test {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kSecondsPerFrame = 0.011;
constexpr std::uint32_t kFirstTick = 0xFFFF'FFFF - 60'000'000;
constexpr std::uint32_t kColorDelay = 300'000;  // ticks: 5 ms

std::string file_name(char type, double seconds, std::uint32_t ticks, const char* extension) {
  char name[64];
  std::snprintf(name, sizeof name, "%c-%.6f-%u.%s", type, 1000 + seconds, ticks, extension);
  return name;
}

template <class T>
void write_image(const std::filesystem::path& file, const char* header,
                 const std::vector<T>& pixels) {
  std::ofstream out(file, std::ios::binary);
  out << header << '\n';
  out.write(reinterpret_cast<const char*>(pixels.data()),
            static_cast<std::streamsize>(pixels.size() * sizeof(T)));
}

std::vector<std::uint16_t> depth_of(int frame) {
  std::vector<std::uint16_t> pixels;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    pixels.push_back(kinect_number(i % kWidth, i / kWidth, frame));
  }
  return pixels;
}

std::vector<std::uint8_t> color_of(int frame) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    for (const int value : {frame, i % kWidth, i / kWidth}) {
      pixels.push_back(static_cast<std::uint8_t>(value % 256));
    }
  }
  return pixels;
}

}  // namespace

void write_kinect_session(const std::filesystem::path& folder, int frames) {
  std::filesystem::create_directories(folder);
  std::ofstream index(folder / "INDEX.txt");
  for (int i = 0; i < frames; ++i) {
    const double seconds = kSecondsPerFrame * i;
    const std::uint32_t ticks = kFirstTick + static_cast<std::uint32_t>(i) * kTicksPerFrame;
    const std::string depth = file_name('d', seconds, ticks, "pgm");
    const std::string color = file_name('r', seconds + 0.002, ticks + kColorDelay, "ppm");
    write_image(folder / depth, "P5 640 480 65535", depth_of(i));
    write_image(folder / color, "P6 640 480 255", color_of(i));
    index << depth << '\n' << color << '\n';
  }
}

}  // namespace armsreach::test
