// What finds hands and what their gestures mean, as the configuration says, else as the program
// brings it along.
#pragma once

#include <optional>

#include "app/pipelines/hands_stage.hpp"
#include "app/session/config.hpp"
#include "vision/core/event.hpp"
#include "vision/core/result.hpp"

namespace armsreach::app {

// Nothing where the gaze can turn, or nobody has asked it to; `gimbal`: whether one carries the
// sensor and hands are looked for.
std::optional<FaultEvent> cannot_follow(const GazeConfig& gaze, bool gimbal);

Result<HandsSetup> make_hands_setup(const Config& all);

}  // namespace armsreach::app
