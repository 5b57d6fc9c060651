// Codec of a gimbal's description, as it stands in rig files and world files:
//
//   order: [pan, tilt, roll]              # from the mount outwards
//   base: {rotation_vector: [0, 0, 0], translation: [0, 0, 0]}       # mount_from_base; rad, m
//   offsets: [[0, 0, 0], [0, 0, 0], [0, 0, 0]]                       # m, see GimbalModel
//   lower_deg: [-90, -60, -45]            # of pan, tilt and roll, whatever the order
//   upper_deg: [90, 60, 45]
//   fastest_deg: [300, 300, 300]          # deg/s
//   acceleration_deg: [3400, 3400, 3400]  # deg/s^2
//   lag: 0.02                             # s
//
// Every entry may be left out.
#pragma once

#include <ostream>

#include "vision/core/gimbal.hpp"
#include "vision/core/yaml_map.hpp"

namespace armsreach {

// For readers of files that have gimbals among other things: throws YamlComplaint.
GimbalModel gimbal_model_from(YamlMap map);

// As one flow map, "{order: ..., ...}".
void write_gimbal_model(std::ostream& out, const GimbalModel& model);

}  // namespace armsreach
