// What there is to say about an event. A new kind of event gets its sentence in remarks.cpp.
#pragma once

#include <optional>

#include "devices/speech/sentence.hpp"
#include "vision/core/event.hpp"

namespace armsreach::app {

// Nothing for events that are seen rather than heard.
std::optional<Sentence> remark_on(const Event& event);

}  // namespace armsreach::app
