// Codec of rig files:
//
//   sensors:
//     - name: depth
//       source: tum:kitchen              # a path is relative to the rig file's folder
//       camera: kinect.yaml              # only where it is not the source's own
//       rig_from_sensor: {rotation_vector: [0, 0, 0], translation: [0.1, 0, 0]}  # rad, m
//       gimbal: {order: [pan, tilt, roll], ...}   # gimbal_yaml.hpp; of a recording,
//       gimbal_states: gimbal.txt                 # and how it moved then
//   actuators:                         # rig_actuators_yaml.hpp
//     gaze: {kind: firmata, port: /dev/ttyACM0, carries: depth}
#pragma once

#include <filesystem>
#include <istream>
#include <ostream>
#include <string>

#include "devices/rig.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

// Unknown keys are refused by name; `where` names the stream in errors.
Result<RigSpec> read_rig_yaml(std::istream& in, const std::string& where);

void write_rig_yaml(std::ostream& out, const RigSpec& rig);

Result<RigSpec> read_rig_file(const std::filesystem::path& file);

}  // namespace armsreach
