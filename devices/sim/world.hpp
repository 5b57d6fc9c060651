// A simulated world as plain data: things, light, the camera's path and its sensor. World frame: z
// up, the floor at z = 0. Metres, seconds, radians; colours are sRGB, 0..1, red first.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/hand/hand_script.hpp"
#include "devices/sim/infrared/infrared_description.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

using Color = Eigen::Vector3d;

// Shapes stand on z = 0 around the origin of their thing, z up.
struct Box {
  Eigen::Vector3d size;
};
struct Cylinder {
  double radius = 0;
  double height = 0;
};
// A rectangle in z = 0 around the origin, seen from +z only: floor and walls. It casts no shadow.
struct Panel {
  Eigen::Vector2d size;
};
// A solid of revolution: (radius, z) from the lower end on the axis to the upper one.
struct Lathe {
  std::vector<Eigen::Vector2d> profile;
};
// Its handle points along +x.
struct Mug {
  double radius = 0;
  double height = 0;
  double wall = 0;
};
using Shape = std::variant<Box, Cylinder, Panel, Lathe, Mug>;

enum class Pattern {
  plain,      // colours: 1, with a faint mottle
  wood,       // light, dark
  fabric,     // ground, stripe, stripe
  tiles,      // tile, other tile, joint
  plaster,    // ground
  cardboard,  // ground
  glaze,      // ground, band, speck
  label,      // ground, band, ink, accent: a packet's or tin's print
  book,       // cover, ink, accent
  landscape,  // frame, mount, sky, sun, then hills from far to near: a picture
  shapes,     // frame, mount, ground, then shapes: a picture
  leaves,     // frame, mount, ground, leaf, leaf: a picture
};

struct Material {
  std::string name;
  Pattern pattern = Pattern::plain;
  std::vector<Color> colors;
  double size = 1;   // m that one repeat of the pattern covers
  bool fit = false;  // the pattern covers each face just once instead
  double shine = 0;  // 0 dull .. 1 glazed: strength of the highlight, and of a depth camera's glare
  double infrared = 1;  // share of the depth camera's light that comes back; 0: no depth at all
};

struct Thing {
  std::string name;
  Shape shape;
  Pose world_from_thing;
  int material = 0;  // index into World::materials
};

// A broad far light (a window, the sun) and what the room sends back from all sides.
struct Light {
  Eigen::Vector3d towards{0, 0, 1};  // unit, from the things to the light
  double spread = 0.1;               // rad, half angle: how soft shadows are
  Color key{1, 1, 1};                // irradiance on a surface that faces the light
  Color above{0.5, 0.5, 0.5};        // radiance from above and from below
  Color below{0.2, 0.2, 0.2};
};

struct PathKey {
  double time = 0;
  Eigen::Vector3d eye;
  Eigen::Vector3d target;  // what the camera looks at
  double roll = 0;         // about the viewing direction
};

// How a hand holds the camera, as rms of each axis: slow sway and the tremor of muscles.
struct Tremor {
  double sway = 0;         // m
  double sway_angle = 0;   // rad
  double shake = 0;        // m
  double shake_angle = 0;  // rad
};

struct PathDescription {
  double duration = 0;        // s
  bool closed = false;        // from the last key on to the first, which is there at `duration`
  std::vector<PathKey> keys;  // times strictly increasing from 0
  Tremor tremor;
};

// What a colour camera makes of an exact picture. The defaults are a decent webcam's indoors.
struct ColorDescription {
  double noise = 1.5;            // shot noise: grey levels rms, alike at all but the darkest
  double exposure = 0.006;       // s; what moves meanwhile blurs; 0: nothing does
  double exposure_lag = 0.4;     // s in which 63 % of a change of light are made up for; 0: never
  double exposure_drift = 0.03;  // largest slow relative change of brightness
  double white_balance_drift = 0.02;  // largest slow relative change of red, and of blue against it
  double sharpness = 0.76;            // of a point's light, what its own pixel gets in a row
  int jpeg_quality = 92;              // 1 .. 100; 0: not compressed
};
// Changes nothing.
inline constexpr ColorDescription kCleanColor{0, 0, 0, 0, 0, 1, 0};

struct SensorDescription {
  int width = 640;
  int height = 480;
  double field_of_view = 1.0;  // rad, horizontal
  double rate = 30;            // Hz
  double nearest = 0;          // m: no depth nearer than this
  double farthest = 10;        // m
  double noise = 1;            // depth noise in units of the Kinect's; 0: an exact sensor
  ColorDescription color;
};

struct World {
  std::string name;
  std::string about;  // one line for the list of sources
  std::vector<Material> materials;
  std::vector<Thing> things;
  Light light;
  PathDescription path;
  SensorDescription sensor;
  std::vector<HandDescription> hands;
  std::optional<InfraredDescription> infrared;
};

}  // namespace armsreach::sim
