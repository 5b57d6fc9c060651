#include <numbers>

#include "devices/sim/world_yaml_parts.hpp"

namespace armsreach::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

template <class Key>
void check_time(const YamlMap& map, const std::vector<Key>& keys, double time) {
  if (keys.empty() ? time != 0 : time <= keys.back().time)
    throw map.complaint("the times of '" + map.path("keys") + "' do not increase from 0");
}

std::vector<PathKey> path_keys(YamlMap& map, double duration) {
  std::vector<PathKey> keys;
  for (YamlMap& entry : map.items("keys")) {
    PathKey key;
    key.time = entry.number("time", 0, duration);
    key.eye = entry.vector<3>("eye");
    key.target = entry.vector<3>("target");
    key.roll = kRadians * entry.number("roll_deg", -180, 180, 0);
    entry.refuse_others();
    check_time(map, keys, key.time);
    keys.push_back(key);
  }
  return keys;
}

}  // namespace

PathDescription path_from(YamlMap map) {
  PathDescription path;
  path.duration = map.number("duration", 0.01, 3600);
  path.closed = map.flag("closed");
  path.tremor.sway = map.number("sway", 0, 0.1, 0);
  path.tremor.sway_angle = kRadians * map.number("sway_deg", 0, 10, 0);
  path.tremor.shake = map.number("shake", 0, 0.1, 0);
  path.tremor.shake_angle = kRadians * map.number("shake_deg", 0, 10, 0);
  if (map.find("keys")) path.keys = path_keys(map, path.duration);
  if (path.closed && !path.keys.empty() && path.keys.back().time >= path.duration)
    throw map.complaint("a closed path needs time after its last key to come back to the first");
  map.refuse_others();
  return path;
}

WearerDescription wearer_from(YamlMap map) {
  WearerDescription wearer;
  wearer.height = map.number("height", 0.5, 2.5);
  wearer.sway = map.number("sway", 0, 0.1, wearer.sway);
  for (YamlMap& entry : map.items("keys")) {
    WearerKey key;
    key.time = entry.number("time", 0, 3600);
    key.stand = entry.vector<2>("stand");
    key.heading = kRadians * entry.number("heading_deg", -360, 360);
    key.look = entry.vector<3>("look");
    key.reach = entry.number("reach", 0, 1, 0);
    entry.refuse_others();
    check_time(map, wearer.keys, key.time);
    wearer.keys.push_back(key);
  }
  if (wearer.keys.empty()) throw map.complaint("keys", "is empty");
  map.refuse_others();
  return wearer;
}

}  // namespace armsreach::sim
