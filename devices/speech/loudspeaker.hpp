// A sound device through ALSA. PulseAudio and PipeWire answer as ALSA's default device too.
#pragma once

#include <atomic>
#include <string>

#include "vision/core/result.hpp"
#include "vision/core/sound.hpp"

namespace armsreach {

// Plays until the end, until `stop` is set (silent within some 20 ms), or until the device fails.
// Opened for each sound, so that a device that went and came back is found again.
Status play(const std::string& device, const Sound& sound, const std::atomic<bool>& stop);

}  // namespace armsreach
