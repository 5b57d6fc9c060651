// Codec of world files. A world is a map of
//
//   about: one line
//   sensor: {width, height, field_of_view_deg, rate, depth_range: [near, far], noise,
//            color: as in color_yaml.hpp,
//            mount: path | head | shoulder, path: its own, as below, offset: {at, turn_deg},
//            gimbal: as in gimbal_yaml.hpp, gimbal_script: [{t, angles_deg: [pan, tilt, roll]}]}
//   light: {towards: [x, y, z], spread_deg, key: colour, key_strength, above, below,
//           ambient_strength}
//   path: {duration, closed, sway, sway_deg, shake, shake_deg,
//          keys: [{time, eye: [x, y, z], target: [x, y, z], roll_deg}, ...]}
//   wearer: {height, sway, keys: [{time, stand: [x, y], heading_deg, look: [x, y, z], reach}, ...]}
//   materials: {NAME: {pattern, colors: ["#rrggbb", ...], size | fit, shine, infrared}, ...}
//              or, in place of pattern and colors, texture: FILE of a picture
//   things: [{name, at: [x, y, z], turn_deg: [x, y, z], SHAPE, material}, ...]
//   motions: [{thing: NAME, keys: [{t, at, turn_deg} | {t, rest: true}, ...]}, ...]
//   hands: none, or as in hand_yaml.hpp
//   infrared: none, or as in infrared/infrared_yaml.hpp
//   shown_by: main | ir, the sensor that is meant when none is named
//
// in metres and seconds, with angles in degrees where the key says so; gimbal, path of the sensor,
// offset, wearer, motions, hands and shown_by (main) may be left out. SHAPE is one of
//
//   box: [x, y, z]   cylinder: [radius, height]   capsule: [radius, height]   panel: [x, y]
//   mug: [radius, height, wall]   lathe: [[radius, z], ...]
//   tapered: [lower x, lower y, upper x, upper y, height]
//   slab: {outline: [[x, low y, high y], ...], thickness}
//   mesh: FILE, with scale: the metres that a unit of the file is, if not 1
//
// or, of a thing of several pieces, `parts: [{SHAPE, at, turn_deg, material}, ...]` in the thing's
// frame. What is turned is turned about the outer frame's x, then y, then z, and then moved to
// `at`. A motion starts where the thing stands; keys at rest keep it where it was. A path with a
// single key is a tripod, and a wearer's world needs of its path only the duration. This codec
// names the files of meshes and pictures; world_files.hpp loads them.
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
