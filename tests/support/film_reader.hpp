// Reads films back through libavformat, without the program's own code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace armsreach::test {

struct VideoPacket {
  std::int64_t pts = 0;  // in units of `time_base`
  std::int64_t dts = 0;
  double time_base = 0;  // s
  std::string bytes;
};
std::vector<VideoPacket> video_packets(const std::filesystem::path& film);

struct FilmSound {
  int streams = 0;              // of sound in the film
  int rate = 0;                 // Hz
  std::vector<double> samples;  // -1..1, from the film's start

  double rms(double from, double to) const;  // between two times, s; beyond the end is silence
};
FilmSound film_sound(const std::filesystem::path& film);

}  // namespace armsreach::test
