// Sound as plain samples, and sounds laid out along source time.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vision/core/time.hpp"

namespace armsreach {

struct Sound {
  int rate = 16000;                   // samples a second
  std::vector<std::int16_t> samples;  // one channel

  double seconds() const { return static_cast<double>(samples.size()) / rate; }
};

struct PlacedSound {
  Timestamp start = 0;
  std::shared_ptr<const Sound> sound;
};
using SoundTrack = std::vector<PlacedSound>;  // in order of time, one rate, none overlapping

}  // namespace armsreach
