// What finds hands and what their gestures mean, as the configuration says, else as the program
// brings it along.
#pragma once

#include "app/pipelines/hands_stage.hpp"
#include "app/session/config.hpp"
#include "vision/core/result.hpp"

namespace armsreach::app {

Result<HandsSetup> make_hands_setup(const GestureConfig& config, const ShowConfig& show);

}  // namespace armsreach::app
