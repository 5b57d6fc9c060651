// Simulated hands in front of any other source: "sim-hand:tum:DIR,script=gestures".
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "devices/open.hpp"
#include "devices/sim/hand/hand_script.hpp"
#include "devices/source.hpp"

namespace armsreach {

// Opens what is behind the hands by one of `others`, whose options can be given beside ours.
SourceKind hand_source_kind(const std::vector<SourceKind>& others);

namespace sim {

// The script begins with the first frame. Hands are lit as the picture is, hide what is behind them
// and are hidden by what the frame's depth says is in front; depth is measured as the Kinect would.
// Each frame's truth gains the hands, their masks and, where it is known, their depth; a frame
// without truth gets one, in the camera's frame where it has no pose. `seed` is that of the
// sensors' noise. A script in the world's frame needs frames with a pose: without one the frame is
// an error.
std::unique_ptr<Source> make_hand_source(std::unique_ptr<Source> scene,
                                         const std::vector<HandDescription>& hands,
                                         std::uint64_t seed = 1);

}  // namespace sim
}  // namespace armsreach
