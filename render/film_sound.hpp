// Gives a finished film its sound track: the video's packets are copied as they are, the sound is
// encoded as AAC.
#pragma once

#include <filesystem>

#include "vision/core/result.hpp"
#include "vision/core/sound.hpp"

namespace armsreach::render {

// `track` in the film's own time, from 0. The film is replaced at the end in one step: whatever
// goes wrong before leaves it as it was, silent. The same film and track give the same file.
Status add_sound(const std::filesystem::path& film, const SoundTrack& track);

}  // namespace armsreach::render
