// Codec of what a colour camera does to its pictures:
//
//   clean | {noise, exposure_ms, exposure_lag, exposure_drift, white_balance_drift, sharpness,
//   jpeg}
//
// All may be left out; what they mean and are then is in world.hpp's ColorDescription.
#pragma once

#include <string>

#include "devices/sim/world.hpp"

namespace YAML {
class Node;
}

namespace armsreach::sim {

// For readers of world files: throws YamlComplaint.
ColorDescription color_sensor_from(const YAML::Node& node, const std::string& name);

}  // namespace armsreach::sim
