// Codec of world files. A world is a map of
//
//   about: one line
//   sensor: {width, height, field_of_view_deg, rate, depth_range: [near, far], noise,
//            color: as in color_yaml.hpp}
//   light: {towards: [x, y, z], spread_deg, key: colour, key_strength, above, below,
//           ambient_strength}
//   path: {duration, closed, sway, sway_deg, shake, shake_deg,
//          keys: [{time, eye: [x, y, z], target: [x, y, z], roll_deg}, ...]}
//   materials: {NAME: {pattern, colors: ["#rrggbb", ...], size | fit, shine, infrared}, ...}
//   things: [{name, SHAPE, at: [x, y, z], turn_deg: [x, y, z], material}, ...]
//   hands: none, or as in hand_yaml.hpp
//   infrared: none, or as in infrared/infrared_yaml.hpp
//
// in metres and seconds, with angles in degrees where the key says so. SHAPE is one of box: [x, y,
// z], cylinder: [radius, height], panel: [x, y], mug: [radius, height, wall], lathe: [[radius, z],
// ...]. A thing is turned about x, then y, then z of the world, and stands at `at`.
#pragma once

#include <istream>
#include <string>

#include "devices/sim/world.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

// `where` names the stream in errors. Keys that are unknown, entries that are missing or make no
// sense are errors that name them.
Result<World> read_world_yaml(std::istream& in, const std::string& where);

}  // namespace armsreach::sim
