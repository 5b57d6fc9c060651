#include "devices/sim/world_yaml.hpp"

#include <algorithm>
#include <numbers>

#include "devices/sim/hand_yaml.hpp"
#include "devices/sim/infrared/infrared_yaml.hpp"
#include "devices/sim/world_yaml_parts.hpp"

namespace armsreach::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

Light light_from(YamlMap map) {
  Light light;
  light.towards = map.vector<3>("towards");
  if (light.towards.norm() < 1e-6) throw map.complaint("towards", "is no direction");
  light.towards.normalize();
  light.spread = kRadians * map.number("spread_deg", 0, 80);
  light.key = map.number("key_strength", 0, 10) * map.color("key");
  const double ambient = map.number("ambient_strength", 0, 10);
  light.above = ambient * map.color("above");
  light.below = ambient * map.color("below");
  map.refuse_others();
  return light;
}

void check_carrier(const World& world) {
  const SensorDescription& sensor = world.sensor;
  const bool has_path = !(sensor.path ? *sensor.path : world.path).keys.empty();
  if (sensor.mount == Mount::path && !has_path)
    throw YamlComplaint("'path.keys' is missing, along which the sensor moves");
  if (sensor.mount != Mount::path && !world.wearer)
    throw YamlComplaint("'wearer' is missing, who carries the sensor");
}

Thing& thing_named(const std::string& name, std::vector<Thing>& things) {
  const auto thing = std::find_if(things.begin(), things.end(),
                                  [&name](const Thing& one) { return one.name == name; });
  if (thing == things.end()) throw YamlComplaint("'hands': there is no thing '" + name + "'");
  return *thing;
}

// A thing is either carried by hands, or moves by itself with hands on it.
void take_in_hand(const HandDescription& hand, std::vector<Thing>& things) {
  for (const HandKey& key : hand.keys) {
    if (!key.on.empty()) thing_named(key.on, things);
    if (key.hold.empty()) continue;
    Thing& thing = thing_named(key.hold, things);
    if (key.on != key.hold && !thing.keys.empty()) {
      throw YamlComplaint("'hands': '" + key.hold +
                          "' moves by itself; hold it with 'on: " + key.hold + "'");
    }
    if (key.on == key.hold && thing.keys.empty())
      throw YamlComplaint("'hands': '" + key.hold + "' has no motion for the hand on it to follow");
    thing.moves = true;
  }
}

World world_from(const YAML::Node& root) {
  YamlMap map(root, "");
  World world;
  world.about = map.text("about");
  world.light = light_from(map.section("light"));
  world.path = path_from(map.section("path"));
  if (map.find("wearer")) world.wearer = wearer_from(map.section("wearer"));
  world.sensor = sensor_from(map.section("sensor"));
  check_carrier(world);
  const YAML::Node materials = map.need("materials");
  if (!materials.IsMap()) throw map.complaint("materials", "is not a map");
  for (const auto& entry : materials) {
    const std::string name = entry.first.Scalar();
    world.materials.push_back(material_from(name, {entry.second, "materials." + name}));
  }
  for (const YamlMap& thing : map.items("things")) add_thing(thing, world);
  if (map.find("motions")) {
    for (const YamlMap& motion : map.items("motions")) add_motion(motion, world);
  }
  if (map.find("hands")) world.hands = hands_from(map);
  if (map.find("infrared")) {
    world.infrared = infrared_from(map.section("infrared"));
    const bool right = !world.hands.empty() && !world.hands.front().left &&
                       world.hands.front().frame == HandFrame::world;
    if (!right)
      throw map.complaint("infrared", "needs a right hand in the world's frame as the first");
    world.hands.front().glove = world.infrared->glove.has_value();
  }
  for (const HandDescription& hand : world.hands) take_in_hand(hand, world.things);
  if (map.find("shown_by")) {
    world.shown_by = map.text("shown_by");
    const bool known = world.shown_by == "main" || (world.shown_by == "ir" && world.infrared);
    if (!known)
      throw map.complaint("shown_by", "names no sensor: it is main, or ir where there is one");
  }
  map.refuse_others();
  return world;
}

}  // namespace

Result<World> read_world_yaml(std::istream& in, const std::string& where) {
  const std::string remedy = "assets/worlds/bench.yaml shows all that a world can have";
  auto world = read_yaml(in, where, remedy, world_from);
  if (world) world->name = where;
  return world;
}

}  // namespace armsreach::sim
