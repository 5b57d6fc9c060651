// Codecs of what a recording knows of its gimbal. `gimbal.txt`: where the axes were,
// "time pan tilt roll pan-rate tilt-rate roll-rate" a line, in s, rad and rad/s, '#' comments.
// `commands.jsonl`: what they were told, {"t": s, "angles": [pan, tilt, roll]} a line.
#pragma once

#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include "vision/core/gimbal.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

// Times increase; errors name the line.
Result<std::vector<GimbalState>> read_gimbal_states(std::istream& in, const std::string& where);
void write_gimbal_state(std::ostream& out, const GimbalState& state);
void write_gimbal_command(std::ostream& out, const GimbalCommand& command);

}  // namespace armsreach
