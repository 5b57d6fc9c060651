#include "devices/sim/world_yaml.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <yaml-cpp/yaml.h>

#include "devices/sim/color_yaml.hpp"
#include "devices/sim/hand_yaml.hpp"
#include "devices/sim/infrared/infrared_yaml.hpp"
#include "devices/sim/yaml_map.hpp"

namespace armsreach::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

using Map = YamlMap;

SensorDescription sensor_from(Map map) {
  SensorDescription sensor;
  sensor.width = static_cast<int>(map.number("width", 16, 4096));
  sensor.height = static_cast<int>(map.number("height", 16, 4096));
  sensor.field_of_view = kRadians * map.number("field_of_view_deg", 5, 150);
  sensor.rate = map.number("rate", 0.1, 1000);
  const Eigen::Vector2d range = map.vector<2>("depth_range");
  sensor.nearest = range[0];
  sensor.farthest = range[1];
  if (sensor.nearest < 0 || sensor.farthest <= sensor.nearest)
    throw Complaint{"'sensor.depth_range' is not [near, far]"};
  sensor.noise = map.number("noise", 0, 100);
  if (const YAML::Node color = map.find("color"))
    sensor.color = color_sensor_from(color, map.path("color"));
  map.refuse_others();
  return sensor;
}

Light light_from(Map map) {
  Light light;
  light.towards = map.vector<3>("towards");
  if (light.towards.norm() < 1e-6) throw Complaint{"'light.towards' is no direction"};
  light.towards.normalize();
  light.spread = kRadians * map.number("spread_deg", 0, 80);
  light.key = map.number("key_strength", 0, 10) * map.color("key");
  const double ambient = map.number("ambient_strength", 0, 10);
  light.above = ambient * map.color("above");
  light.below = ambient * map.color("below");
  map.refuse_others();
  return light;
}

PathDescription path_from(Map map) {
  PathDescription path;
  path.duration = map.number("duration", 0.01, 3600);
  path.closed = map.flag("closed");
  path.tremor.sway = map.number("sway", 0, 0.1, 0);
  path.tremor.sway_angle = kRadians * map.number("sway_deg", 0, 10, 0);
  path.tremor.shake = map.number("shake", 0, 0.1, 0);
  path.tremor.shake_angle = kRadians * map.number("shake_deg", 0, 10, 0);
  const YAML::Node keys = map.need("keys");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    Map entry(keys[i], map.path("keys[" + std::to_string(i) + "]"));
    PathKey key;
    key.time = entry.number("time", 0, path.duration);
    key.eye = entry.vector<3>("eye");
    key.target = entry.vector<3>("target");
    key.roll = kRadians * entry.number("roll_deg", -180, 180, 0);
    entry.refuse_others();
    const bool in_order = i == 0 ? key.time == 0 : key.time > path.keys.back().time;
    if (!in_order) throw Complaint{"the times of 'path.keys' do not increase from 0"};
    path.keys.push_back(key);
  }
  if (path.keys.size() < 2) throw Complaint{"'path.keys' has fewer than two"};
  if (path.closed && path.keys.back().time >= path.duration)
    throw Complaint{"a closed path needs time after its last key to come back to the first"};
  map.refuse_others();
  return path;
}

struct PatternName {
  const char* name;
  Pattern pattern;
  std::size_t colors;  // fewest that it needs
};
constexpr std::array kPatterns{
    PatternName{"plain", Pattern::plain, 1},         PatternName{"wood", Pattern::wood, 2},
    PatternName{"fabric", Pattern::fabric, 3},       PatternName{"tiles", Pattern::tiles, 3},
    PatternName{"plaster", Pattern::plaster, 1},     PatternName{"glaze", Pattern::glaze, 3},
    PatternName{"cardboard", Pattern::cardboard, 1}, PatternName{"label", Pattern::label, 4},
    PatternName{"landscape", Pattern::landscape, 6}, PatternName{"book", Pattern::book, 3},
    PatternName{"shapes", Pattern::shapes, 5},       PatternName{"leaves", Pattern::leaves, 5}};

Material material_from(const std::string& name, Map map) {
  Material material;
  material.name = name;
  const std::string pattern = map.text("pattern");
  const auto known = std::find_if(kPatterns.begin(), kPatterns.end(),
                                  [&](const PatternName& p) { return pattern == p.name; });
  if (known == kPatterns.end())
    throw Complaint{"'" + map.path("pattern") + "': there is no pattern '" + pattern + "'"};
  material.pattern = known->pattern;
  for (const YAML::Node& color : map.need("colors"))
    material.colors.push_back(color_from(color, map.path("colors")));
  if (material.colors.size() < known->colors)
    throw Complaint{"'" + map.path("colors") + "' has fewer than the " +
                    std::to_string(known->colors) + " that '" + pattern + "' needs"};
  material.fit = map.flag("fit");
  material.size = material.fit ? 1 : map.number("size", 0.001, 100);
  material.shine = map.number("shine", 0, 1, 0);
  material.infrared = map.number("infrared", 0, 1, 1);
  map.refuse_others();
  return material;
}

Lathe lathe_from(const YAML::Node& node, const std::string& name) {
  Lathe lathe;
  for (const YAML::Node& point : node) {
    const std::vector<double> values = numbers_from(point, name);
    if (values.size() != 2 || values[0] < 0)
      throw Complaint{"'" + name + "' has a point that is not [radius, z]"};
    lathe.profile.emplace_back(values[0], values[1]);
  }
  if (lathe.profile.size() < 2) throw Complaint{"'" + name + "' has fewer than two points"};
  return lathe;
}

Shape shape_from(Map& map) {
  std::vector<Shape> shapes;
  if (map.find("box")) shapes.push_back(Box{map.lengths<3>("box")});
  if (map.find("panel")) shapes.push_back(Panel{map.lengths<2>("panel")});
  if (map.find("cylinder")) {
    const Eigen::Vector2d size = map.lengths<2>("cylinder");
    shapes.push_back(Cylinder{size[0], size[1]});
  }
  if (map.find("mug")) {
    const Eigen::Vector3d size = map.lengths<3>("mug");
    if (size[2] >= size[0] / 2) throw Complaint{"'" + map.path("mug") + "' is all wall"};
    shapes.push_back(Mug{size[0], size[1], size[2]});
  }
  if (const YAML::Node node = map.find("lathe"))
    shapes.push_back(lathe_from(node, map.path("lathe")));
  if (shapes.size() != 1)
    throw Complaint{"'" + map.path("") + "' needs one shape: box, cylinder, panel, mug or lathe"};
  return shapes.front();
}

Pose pose_from(Map& map) {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  if (map.find("turn_deg")) turn = kRadians * map.vector<3>("turn_deg");
  const auto about = [&turn](int axis) {
    return Eigen::AngleAxisd(turn[axis], Eigen::Vector3d::Unit(axis));
  };
  return {Eigen::Quaterniond(about(2) * about(1) * about(0)), map.vector<3>("at")};
}

Thing thing_from(Map map, const std::vector<Material>& materials) {
  Thing thing;
  thing.name = map.text("name");
  thing.shape = shape_from(map);
  thing.world_from_thing = pose_from(map);
  const std::string wanted = map.text("material");
  const auto material = std::find_if(materials.begin(), materials.end(),
                                     [&](const Material& m) { return m.name == wanted; });
  if (material == materials.end())
    throw Complaint{"'" + map.path("material") + "': there is no material '" + wanted + "'"};
  thing.material = static_cast<int>(material - materials.begin());
  map.refuse_others();
  return thing;
}

void refuse_unknown_things(const HandDescription& hand, const std::vector<Thing>& things) {
  for (const HandKey& key : hand.keys) {
    const bool known = key.hold.empty() ||
                       std::any_of(things.begin(), things.end(),
                                   [&key](const Thing& thing) { return thing.name == key.hold; });
    if (!known) throw Complaint{"'hands': there is no thing '" + key.hold + "' to hold"};
  }
}

World world_from(const YAML::Node& root) {
  Map map(root, "");
  World world;
  world.about = map.text("about");
  world.sensor = sensor_from({map.need("sensor"), "sensor"});
  world.light = light_from({map.need("light"), "light"});
  world.path = path_from({map.need("path"), "path"});
  const YAML::Node materials = map.need("materials");
  if (!materials.IsMap()) throw Complaint{"'materials' is not a map"};
  for (const auto& entry : materials) {
    const std::string name = entry.first.Scalar();
    world.materials.push_back(material_from(name, {entry.second, "materials." + name}));
  }
  const YAML::Node things = map.need("things");
  for (std::size_t i = 0; i < things.size(); ++i) {
    world.things.push_back(
        thing_from({things[i], "things[" + std::to_string(i) + "]"}, world.materials));
  }
  if (const YAML::Node hands = map.find("hands")) world.hands = hands_from(hands, "hands");
  if (const YAML::Node node = map.find("infrared")) {
    world.infrared = infrared_from(node, "infrared");
    const bool right = !world.hands.empty() && !world.hands.front().left &&
                       world.hands.front().frame == HandFrame::world;
    if (!right) throw Complaint{"'infrared' needs a right hand in the world's frame as the first"};
  }
  for (const HandDescription& hand : world.hands) refuse_unknown_things(hand, world.things);
  map.refuse_others();
  return world;
}

}  // namespace

Result<World> read_world_yaml(std::istream& in, const std::string& where) {
  const std::string remedy = "assets/worlds/bench.yaml shows all that a world can have";
  try {
    World world = world_from(YAML::Load(in));
    world.name = where;
    return world;
  } catch (const Complaint& complaint) {
    return Error{complaint.what, where, remedy};
  } catch (const YAML::Exception& e) {
    return Error{"not readable as YAML: " + std::string(e.what()), where, remedy};
  }
}

}  // namespace armsreach::sim
