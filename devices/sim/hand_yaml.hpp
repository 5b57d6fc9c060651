// Codec of what simulated hands do. A list of
//
//   {side: right | left, seed, skin: pale | light | medium | tan | brown | dark, sleeve: "#rrggbb",
//    shoulder: [x, y, z], frame: camera | world, repeat: SECONDS,
//    keys: [{t, pose: NAME | grip: DIAMETER, at: [x, y, z], turn_deg: [x, y, z],
//            wrist_deg: [flexion, deviation], hold: THING, on: THING}, ...]}
//
// in seconds and metres; `pose` is point, L, open, fist, grasp, pinch or a numeral from 0 to 9, a
// grip closes around a handle. What places and turns mean is in hand/hand_script.hpp; seed, skin,
// sleeve, shoulder, repeat, turn_deg, wrist_deg, hold and on may be left out. A file of its own has
// the list under `hands`.
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "devices/sim/hand/hand_script.hpp"
#include "vision/core/result.hpp"
#include "vision/core/yaml_map.hpp"

namespace armsreach::sim {

// For readers of files that have `hands` among other things: throws YamlComplaint.
std::vector<HandDescription> hands_from(YamlMap& map);

// `where` names the stream in errors.
Result<std::vector<HandDescription>> read_hand_script(std::istream& in, const std::string& where);

}  // namespace armsreach::sim
