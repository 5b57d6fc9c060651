#include "devices/sim/world_yaml.hpp"

#include <algorithm>
#include <numbers>

#include <yaml-cpp/yaml.h>

#include "devices/sim/hand_yaml.hpp"
#include "devices/sim/infrared/infrared_yaml.hpp"
#include "devices/sim/world_yaml_parts.hpp"

namespace armsreach::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

Light light_from(YamlMap map) {
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

void check_carrier(const World& world) {
  const SensorDescription& sensor = world.sensor;
  const bool has_path = !(sensor.path ? *sensor.path : world.path).keys.empty();
  if (sensor.mount == Mount::path && !has_path)
    throw Complaint{"'path.keys' is missing, along which the sensor moves"};
  if (sensor.mount != Mount::path && !world.wearer)
    throw Complaint{"'wearer' is missing, who carries the sensor"};
}

// What hands hold is there and has no motion of its own.
void take_in_hand(const HandDescription& hand, std::vector<Thing>& things) {
  for (const HandKey& key : hand.keys) {
    if (key.hold.empty()) continue;
    const auto thing = std::find_if(things.begin(), things.end(),
                                    [&key](const Thing& one) { return one.name == key.hold; });
    if (thing == things.end())
      throw Complaint{"'hands': there is no thing '" + key.hold + "' to hold"};
    if (!thing->keys.empty())
      throw Complaint{"'hands': '" + key.hold + "' moves by itself and cannot be held"};
    thing->moves = true;
  }
}

World world_from(const YAML::Node& root) {
  YamlMap map(root, "");
  World world;
  world.about = map.text("about");
  world.light = light_from({map.need("light"), "light"});
  world.path = path_from({map.need("path"), "path"});
  if (const YAML::Node wearer = map.find("wearer")) world.wearer = wearer_from({wearer, "wearer"});
  world.sensor = sensor_from({map.need("sensor"), "sensor"});
  check_carrier(world);
  const YAML::Node materials = map.need("materials");
  if (!materials.IsMap()) throw Complaint{"'materials' is not a map"};
  for (const auto& entry : materials) {
    const std::string name = entry.first.Scalar();
    world.materials.push_back(material_from(name, {entry.second, "materials." + name}));
  }
  const YAML::Node things = map.need("things");
  for (std::size_t i = 0; i < things.size(); ++i)
    add_thing({things[i], "things[" + std::to_string(i) + "]"}, world);
  if (const YAML::Node motions = map.find("motions")) {
    for (std::size_t i = 0; i < motions.size(); ++i)
      add_motion({motions[i], "motions[" + std::to_string(i) + "]"}, world);
  }
  if (const YAML::Node hands = map.find("hands")) world.hands = hands_from(hands, "hands");
  if (const YAML::Node node = map.find("infrared")) {
    world.infrared = infrared_from(node, "infrared");
    const bool right = !world.hands.empty() && !world.hands.front().left &&
                       world.hands.front().frame == HandFrame::world;
    if (!right) throw Complaint{"'infrared' needs a right hand in the world's frame as the first"};
  }
  for (const HandDescription& hand : world.hands) take_in_hand(hand, world.things);
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
