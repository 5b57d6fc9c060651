#include <algorithm>
#include <numbers>

#include <Eigen/Geometry>

#include "devices/sim/world_yaml_parts.hpp"

namespace armsreach::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

int material_index(YamlMap& map, const std::vector<Material>& materials) {
  const std::string wanted = map.text("material");
  const auto material = std::find_if(materials.begin(), materials.end(),
                                     [&](const Material& m) { return m.name == wanted; });
  if (material == materials.end())
    throw map.complaint("material", "cannot be: there is no material '" + wanted + "'");
  return static_cast<int>(material - materials.begin());
}

Thing* thing_named(const std::string& name, std::vector<Thing>& things) {
  const auto found = std::find_if(things.begin(), things.end(),
                                  [&](const Thing& thing) { return thing.name == name; });
  return found == things.end() ? nullptr : &*found;
}

}  // namespace

Pose pose_from(YamlMap& map) {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  if (map.find("turn_deg")) turn = kRadians * map.vector<3>("turn_deg");
  const auto about = [&turn](int axis) {
    return Eigen::AngleAxisd(turn[axis], Eigen::Vector3d::Unit(axis));
  };
  return {Eigen::Quaterniond(about(2) * about(1) * about(0)), map.vector<3>("at")};
}

void add_thing(YamlMap map, World& world) {
  Thing thing;
  thing.name = map.text("name");
  if (thing_named(thing.name, world.things))
    throw map.complaint("name", "cannot be: two things are named '" + thing.name + "'");
  thing.world_from_thing = pose_from(map);
  const int index = static_cast<int>(world.things.size());
  if (map.find("parts")) {
    for (YamlMap& entry : map.items("parts")) {
      Part part{index, shape_from(entry), {}, material_index(entry, world.materials)};
      part.thing_from_part = pose_from(entry);
      entry.refuse_others();
      world.parts.push_back(std::move(part));
    }
  } else {
    world.parts.push_back({index, shape_from(map), {}, material_index(map, world.materials)});
  }
  world.things.push_back(std::move(thing));
  map.refuse_others();
}

void add_motion(YamlMap map, World& world) {
  const std::string name = map.text("thing");
  Thing* thing = thing_named(name, world.things);
  if (!thing) throw map.complaint("thing", "cannot be: there is no thing '" + name + "'");
  if (thing->moves) throw map.complaint("thing", "cannot be: '" + name + "' moves already");
  thing->moves = true;
  thing->keys.push_back({0, thing->world_from_thing});
  for (YamlMap& entry : map.items("keys")) {
    ThingKey key{entry.number("t", 0, 3600), thing->keys.back().world_from_thing};
    if (!entry.flag("rest")) key.world_from_thing = pose_from(entry);
    entry.refuse_others();
    if (key.time <= thing->keys.back().time)
      throw entry.complaint("the times of '" + map.path("keys") + "' do not increase from above 0");
    thing->keys.push_back(key);
  }
  map.refuse_others();
}

}  // namespace armsreach::sim
