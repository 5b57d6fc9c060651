#include <numbers>

#include "devices/sim/world_yaml_parts.hpp"

namespace armsreach::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

}  // namespace

PathDescription path_from(YamlMap map) {
  PathDescription path;
  path.duration = map.number("duration", 0.01, 3600);
  path.closed = map.flag("closed");
  path.tremor.sway = map.number("sway", 0, 0.1, 0);
  path.tremor.sway_angle = kRadians * map.number("sway_deg", 0, 10, 0);
  path.tremor.shake = map.number("shake", 0, 0.1, 0);
  path.tremor.shake_angle = kRadians * map.number("shake_deg", 0, 10, 0);
  const YAML::Node keys = map.find("keys");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    YamlMap entry(keys[i], map.path("keys[" + std::to_string(i) + "]"));
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
  if (path.closed && !path.keys.empty() && path.keys.back().time >= path.duration)
    throw Complaint{"a closed path needs time after its last key to come back to the first"};
  map.refuse_others();
  return path;
}

WearerDescription wearer_from(YamlMap map) {
  WearerDescription wearer;
  wearer.height = map.number("height", 0.5, 2.5);
  wearer.sway = map.number("sway", 0, 0.1, wearer.sway);
  const YAML::Node keys = map.need("keys");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    YamlMap entry(keys[i], map.path("keys[" + std::to_string(i) + "]"));
    WearerKey key;
    key.time = entry.number("time", 0, 3600);
    key.stand = entry.vector<2>("stand");
    key.heading = kRadians * entry.number("heading_deg", -360, 360);
    key.look = entry.vector<3>("look");
    key.reach = entry.number("reach", 0, 1, 0);
    entry.refuse_others();
    const bool in_order = i == 0 ? key.time == 0 : key.time > wearer.keys.back().time;
    if (!in_order) throw Complaint{"the times of 'wearer.keys' do not increase from 0"};
    wearer.keys.push_back(key);
  }
  if (wearer.keys.empty()) throw Complaint{"'wearer.keys' is empty"};
  map.refuse_others();
  return wearer;
}

}  // namespace armsreach::sim
