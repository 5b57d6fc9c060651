// Text to sound by Flite and its male American voice, 16 kHz. About 0.5 ms for a short sentence.
#pragma once

#include <string>

#include "vision/core/sound.hpp"

namespace armsreach {

// Text may be anything; its first 200 characters are said. The same text gives the same samples.
// From any thread.
Sound synthesised(const std::string& text);

}  // namespace armsreach
