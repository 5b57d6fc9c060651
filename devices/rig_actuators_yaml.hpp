// Codec of the actuators of a rig file, each under a name of its own:
//
//   actuators:
//     gaze:
//       kind: firmata                     # three servos on a board with StandardFirmata
//       carries: main                     # the sensor that it moves
//       port: /dev/ttyACM0
//       baud: 57600
//       pins: [9, 10, 11]                 # of pan, tilt and roll
//       zero_us: [1500, 1500, 1500]       # the pulse at which an angle is 0
//       us_per_degree: [10, 10, 10]       # below 0 where a servo turns the other way
//       model: {lower_deg: [-60, -45, -30], ...}   # gimbal_yaml.hpp
//     head:
//       kind: uvc                         # a pan/tilt camera's motors
//       carries: side
//       device: /dev/video0
//       model: {...}
//
// Everything but `kind` may be left out; what then holds is in firmata_gimbal.hpp, uvc_gimbal.hpp
// and gimbal.hpp. `carries` is main, then.
#pragma once

#include "devices/rig.hpp"
#include "vision/core/yaml_map.hpp"

namespace armsreach {

// Into a rig whose sensors have been read. Throws YamlComplaint.
void read_actuators(const YAML::Node& list, RigSpec& rig);

}  // namespace armsreach
