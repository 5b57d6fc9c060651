// Codec of a world's infra-red camera and of what its first hand wears:
//
//   {width, height, lens_mm, pixel_um, distortion: [k1, k2, p1, p2, k3], rate, eye: [x, y, z],
//    target: [x, y, z], up: [x, y, z], tape_level, white_level, noise,
//    bracelet: {radius, segment, spacing, behind, width}, glove: {cell, finger}}
//
// The camera's axis goes through the picture's middle; `up` is upwards in the picture. Levels and
// what is worn are in infrared_description.hpp and worn.hpp; they, rate and noise may be left out.
#pragma once

#include "devices/sim/infrared/infrared_description.hpp"
#include "vision/core/yaml_map.hpp"

namespace armsreach::sim {

// For readers of world files: throws YamlComplaint.
InfraredDescription infrared_from(YamlMap map);

}  // namespace armsreach::sim
