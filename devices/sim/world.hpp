// A simulated world as plain data: things and how they move, light, the wearer and the sensors.
// World frame: z up, the floor at z = 0. Metres, seconds, radians; colours are sRGB, 0..1, red
// first.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "devices/sim/hand/hand_script.hpp"
#include "devices/sim/infrared/infrared_description.hpp"
#include "vision/core/gimbal.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

using Color = Eigen::Vector3d;

// Shapes stand on z = 0 around the origin of their part, z up.
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
// A rod with round ends; the height is that of the whole.
struct Capsule {
  double radius = 0;
  double height = 0;
};
// A box whose upper face has another size: a wedge, a bit, a tray's slope.
struct TaperedBox {
  Eigen::Vector2d lower;
  Eigen::Vector2d upper;
  double height = 0;
};
// A board with a bent outline: at each station along x it reaches from `low` to `high` in y, with
// straight edges between, and it is `thickness` high.
struct Slab {
  struct Station {
    double x = 0;
    double low = 0;
    double high = 0;
  };
  std::vector<Station> stations;  // x increases
  double thickness = 0;
};
// Triangles from a file, in its own frame.
struct MeshTriangle {                        // corners counter-clockwise as seen from outside
  std::array<Eigen::Vector3d, 3> positions;  // m
  std::array<Eigen::Vector3d, 3> normals;    // unit
  std::array<Eigen::Vector2d, 3> pictured;   // where on a fitted picture, 0..1, v down
};
struct Mesh {
  std::string file;  // as the world's file names it
  double scale = 1;  // m that a unit of the file is
  // Until they are loaded there are none.
  std::shared_ptr<const std::vector<MeshTriangle>> triangles;
  // The sides of a convex solid close around them, for what touches it; normals outwards.
  std::vector<Eigen::Hyperplane<double, 3>> around;
};
using Shape = std::variant<Box, Cylinder, Panel, Lathe, Mug, Capsule, TaperedBox, Slab, Mesh>;

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
  texture,    // no colours: a picture from a file
};

struct Material {
  std::string name;
  Pattern pattern = Pattern::plain;
  std::vector<Color> colors;
  double size = 1;   // m that one repeat of the pattern covers
  bool fit = false;  // the pattern covers each face just once instead
  double shine = 0;  // 0 dull .. 1 glazed: strength of the highlight, and of a depth camera's glare
  std::string texture;  // the picture's file as the world's file names it; else empty
  cv::Mat picture;      // what it holds, CV_8UC3 BGR; empty until it is loaded
  double infrared = 1;  // share of the depth camera's light that comes back; 0: no depth at all
};

// Where a thing is at a time. Between two equal keys it rests, and it starts from and comes to rest
// softly; through the others it passes on a smooth curve.
struct ThingKey {
  double time = 0;
  Pose world_from_thing;
};

// One rigid thing, with one pose and one place in the instance masks.
struct Thing {
  std::string name;
  Pose world_from_thing;       // at the start
  std::vector<ThingKey> keys;  // times increase; empty: it never moves
  bool moves = false;          // by its keys or in a hand: its light cannot be gathered beforehand
};

// A piece of a thing's surface.
struct Part {
  int thing = 0;  // index into World::things
  Shape shape;
  Pose thing_from_part;
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
  std::vector<PathKey> keys;  // times strictly increasing from 0; a single one is a tripod
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

// What the wearer does at a time: where they stand and whither they turn, what they look at, and
// how far they reach out.
struct WearerKey {
  double time = 0;
  Eigen::Vector2d stand;  // m
  double heading = 0;     // rad, of the hips, from +x towards +y
  Eigen::Vector3d look;   // what the eyes rest on
  double reach = 0;       // 0 upright .. 1 bent forward and turned with the reaching arm
};

// A person who carries cameras about.
struct WearerDescription {
  double height = 1.7;          // m
  double sway = 0.004;          // m rms, of a standing body
  std::vector<WearerKey> keys;  // times strictly increasing from 0
};

// What a camera is mounted on.
enum class Mount {
  path,      // moved by hand along the path, or still on a tripod
  head,      // of the wearer, looking where the eyes do
  shoulder,  // of the wearer, looking ahead of the chest and down
};

struct SensorDescription {
  Mount mount = Mount::path;
  std::optional<PathDescription> path;       // its own; none: the world's
  Pose mount_from_camera;                    // of the camera, where it has no gimbal
  std::optional<GimbalModel> gimbal;         // between the mount and the camera
  std::vector<GimbalCommand> gimbal_script;  // given to it unless the program moves it
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
  std::vector<Part> parts;
  Light light;
  PathDescription path;  // of whatever is moved by hand; its duration is the world's
  std::optional<WearerDescription> wearer;
  SensorDescription sensor;
  std::vector<HandDescription> hands;
  std::optional<InfraredDescription> infrared;
  std::string shown_by = "main";  // the sensor that is meant when none is named; or "ir"
};

}  // namespace armsreach::sim
