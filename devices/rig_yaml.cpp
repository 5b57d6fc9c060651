#include "devices/rig_yaml.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <utility>

#include "devices/gimbal_yaml.hpp"
#include "devices/rig_actuators_yaml.hpp"

namespace armsreach {
namespace {

constexpr const char* kRemedy =
    "a rig file has sensors: [{name: main, source: SPEC, camera: FILE, rig_from_sensor: "
    "{rotation_vector: [rad, 3 numbers], translation: [m, 3 numbers]}}]";

Pose pose_from(YamlMap map) {
  map.expect({"rotation_vector", "translation"});
  return {so3_exp(map.vector<3>("rotation_vector")), map.vector<3>("translation")};
}

// Maps have no names here: the line says which one it is.
RigSensorSpec sensor_from(YamlMap map) {
  map.expect({"name", "source", "camera", "rig_from_sensor", "gimbal", "gimbal_states"});
  RigSensorSpec sensor;
  sensor.name = map.text("name");
  auto source = parse_source_spec(map.text("source"));
  if (!source) throw YamlComplaint(map.find("source"), source.error().message());
  sensor.source = std::move(*source);
  if (map.find("camera")) sensor.camera = map.text("camera");
  if (const YAML::Node node = map.find("rig_from_sensor"))
    sensor.rig_from_sensor = pose_from({node, ""});
  if (const YAML::Node node = map.find("gimbal")) {
    sensor.gimbal = gimbal_model_from({node, ""});
    sensor.gimbal_states = map.text("gimbal_states");
  }
  return sensor;
}

RigSpec rig_from(const YAML::Node& root) {
  YamlMap map(root, "");
  map.expect({"sensors", "actuators"});
  RigSpec rig;
  const YAML::Node list = map.find("sensors");
  if (!list.IsSequence() || list.size() == 0) throw map.complaint("the rig has no list of sensors");
  for (const YAML::Node& node : list) {
    RigSensorSpec sensor = sensor_from({node, ""});
    const bool taken = std::any_of(rig.sensors.begin(), rig.sensors.end(),
                                   [&](const auto& other) { return other.name == sensor.name; });
    if (taken) throw YamlComplaint(node, "two sensors are named '" + sensor.name + "'");
    rig.sensors.push_back(std::move(sensor));
  }
  if (const YAML::Node actuators = map.find("actuators")) read_actuators(actuators, rig);
  return rig;
}

}  // namespace

Result<RigSpec> read_rig_yaml(std::istream& in, const std::string& where) {
  return read_yaml(in, where, kRemedy, rig_from);
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
