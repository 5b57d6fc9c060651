// A sound track as a WAV file: 16 bit, one channel.
#pragma once

#include <ostream>

#include "vision/core/sound.hpp"

namespace armsreach {

// Silence where nothing is said; starts at `origin` and ends with the last sound.
void write_wav(std::ostream& out, const SoundTrack& track, Timestamp origin);

}  // namespace armsreach
