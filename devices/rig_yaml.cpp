#include "devices/rig_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <utility>

#include <yaml-cpp/yaml.h>

#include "devices/gimbal_yaml.hpp"
#include "devices/rig_actuators_yaml.hpp"

namespace armsreach {
namespace {

constexpr const char* kRemedy =
    "a rig file has sensors: [{name: main, source: SPEC, camera: FILE, rig_from_sensor: "
    "{rotation_vector: [rad, 3 numbers], translation: [m, 3 numbers]}}]";

// Everything below reads one node and complains with the node's place in the file.
Error complaint(const YAML::Node& node, const std::string& where, const std::string& what) {
  std::string place = where;
  if (!node.Mark().is_null()) place.append(":").append(std::to_string(node.Mark().line + 1));
  return {what, place, kRemedy};
}

Status check_keys(const YAML::Node& map, const std::string& where, const std::string& what,
                  std::initializer_list<const char*> known) {
  if (!map.IsMap()) return complaint(map, where, what + " is not a map");
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    return complaint(entry.first, where, "unknown key '" + key + "' in " + what);
  }
  return ok();
}

Result<std::string> read_text(const YAML::Node& map, const std::string& where, const char* key) {
  const YAML::Node node = map[key];
  if (!node) return complaint(map, where, std::string("entry '") + key + "' is missing");
  if (!node.IsScalar() || node.Scalar().empty()) {
    return complaint(node, where, std::string("entry '") + key + "' is not a text");
  }
  return node.Scalar();
}

Result<Eigen::Vector3d> read_vector(const YAML::Node& map, const std::string& where,
                                    const char* key) {
  const YAML::Node node = map[key];
  if (!node) return complaint(map, where, std::string("entry '") + key + "' is missing");
  Eigen::Vector3d vector;
  bool good = node.IsSequence() && node.size() == 3;
  for (int i = 0; good && i < 3; ++i) {
    good = YAML::convert<double>::decode(node[i], vector[i]) && std::isfinite(vector[i]);
  }
  if (!good) return complaint(node, where, std::string("'") + key + "' is not three numbers");
  return vector;
}

Result<Pose> read_pose(const YAML::Node& node, const std::string& where) {
  const auto keys = check_keys(node, where, "rig_from_sensor", {"rotation_vector", "translation"});
  if (!keys) return keys.error();
  auto rotation = read_vector(node, where, "rotation_vector");
  if (!rotation) return std::move(rotation).error();
  auto translation = read_vector(node, where, "translation");
  if (!translation) return std::move(translation).error();
  return Pose(so3_exp(*rotation), *translation);
}

Status read_gimbal(const YAML::Node& node, const std::string& where, RigSensorSpec& sensor) {
  if (!node["gimbal"]) return ok();
  auto model = read_gimbal_model(node["gimbal"], where);
  if (!model) return std::move(model).error();
  auto states = read_text(node, where, "gimbal_states");
  if (!states) return std::move(states).error();
  sensor.gimbal = *model;
  sensor.gimbal_states = *states;
  return ok();
}

Result<RigSensorSpec> read_sensor(const YAML::Node& node, const std::string& where) {
  const auto keys =
      check_keys(node, where, "a sensor",
                 {"name", "source", "camera", "rig_from_sensor", "gimbal", "gimbal_states"});
  if (!keys) return keys.error();
  RigSensorSpec sensor;
  auto name = read_text(node, where, "name");
  if (!name) return std::move(name).error();
  sensor.name = *name;
  auto text = read_text(node, where, "source");
  if (!text) return std::move(text).error();
  auto source = parse_source_spec(*text);
  if (!source) return complaint(node["source"], where, source.error().message());
  sensor.source = std::move(*source);
  if (node["camera"]) {
    auto camera = read_text(node, where, "camera");
    if (!camera) return std::move(camera).error();
    sensor.camera = *camera;
  }
  if (node["rig_from_sensor"]) {
    auto pose = read_pose(node["rig_from_sensor"], where);
    if (!pose) return std::move(pose).error();
    sensor.rig_from_sensor = *pose;
  }
  if (auto status = read_gimbal(node, where, sensor); !status) return status.error();
  return sensor;
}

Result<RigSpec> read_checked(const YAML::Node& root, const std::string& where) {
  if (auto keys = check_keys(root, where, "the rig", {"sensors", "actuators"}); !keys)
    return keys.error();
  const YAML::Node list = root["sensors"];
  if (!list || !list.IsSequence() || list.size() == 0) {
    return complaint(list ? list : root, where, "the rig has no list of sensors");
  }
  RigSpec rig;
  for (const YAML::Node& node : list) {
    auto sensor = read_sensor(node, where);
    if (!sensor) return std::move(sensor).error();
    const bool taken = std::any_of(rig.sensors.begin(), rig.sensors.end(),
                                   [&](const auto& other) { return other.name == sensor->name; });
    if (taken) return complaint(node, where, "two sensors are named '" + sensor->name + "'");
    rig.sensors.push_back(std::move(*sensor));
  }
  if (!root["actuators"]) return rig;
  if (auto status = read_actuators(root["actuators"], where, rig); !status) return status.error();
  return rig;
}

}  // namespace

Result<RigSpec> read_rig_yaml(std::istream& in, const std::string& where) {
  try {
    return read_checked(YAML::Load(in), where);
  } catch (const YAML::Exception& e) {
    return Error{"not readable as YAML: " + std::string(e.what()), where, kRemedy};
  }
}

void write_rig_yaml(std::ostream& out, const RigSpec& rig) {
  const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
  out << "sensors:\n";
  for (const RigSensorSpec& sensor : rig.sensors) {
    YAML::Emitter name;
    name << YAML::DoubleQuoted << sensor.name;
    YAML::Emitter source;
    source << YAML::DoubleQuoted << text_of(sensor.source);
    const Eigen::Vector3d r = so3_log(sensor.rig_from_sensor.rotation());
    const Eigen::Vector3d& t = sensor.rig_from_sensor.translation();
    out << "  - name: " << name.c_str() << "\n    source: " << source.c_str()
        << "\n    rig_from_sensor: {rotation_vector: [" << r.x() << ", " << r.y() << ", " << r.z()
        << "], translation: [" << t.x() << ", " << t.y() << ", " << t.z() << "]}\n";
    if (!sensor.gimbal) continue;
    out << "    gimbal: ";
    write_gimbal_model(out, *sensor.gimbal);
    out << "\n    gimbal_states: " << sensor.gimbal_states << "\n";
  }
  out.precision(precision);
}

Result<RigSpec> read_rig_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return Error{"no such rig file", file.string(), kRemedy};
  auto rig = read_rig_yaml(in, file.string());
  if (rig) rig->folder = file.parent_path();
  return rig;
}

}  // namespace armsreach
