#include <numbers>

#include <yaml-cpp/yaml.h>

#include "devices/gimbal_yaml.hpp"
#include "devices/sim/color_yaml.hpp"
#include "devices/sim/world_yaml_parts.hpp"

namespace armsreach::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

Mount mount_from(YamlMap& map) {
  if (!map.find("mount")) return Mount::path;
  const std::string name = map.text("mount");
  if (name == "head") return Mount::head;
  if (name == "shoulder") return Mount::shoulder;
  if (name == "path") return Mount::path;
  throw Complaint{"'" + map.path("mount") + "' is neither path, head nor shoulder"};
}

std::vector<GimbalCommand> script_from(const YAML::Node& list, const std::string& name) {
  std::vector<GimbalCommand> script;
  for (std::size_t i = 0; i < list.size(); ++i) {
    YamlMap entry(list[i], name + "[" + std::to_string(i) + "]");
    GimbalCommand command;
    command.time = timestamp_from_seconds(entry.number("t", 0, 3600));
    command.angles = kRadians * entry.vector<3>("angles_deg");
    entry.refuse_others();
    if (!script.empty() && command.time <= script.back().time)
      throw Complaint{"the times of '" + name + "' do not increase"};
    script.push_back(command);
  }
  return script;
}

void read_mount(YamlMap& map, SensorDescription& sensor) {
  sensor.mount = mount_from(map);
  if (const YAML::Node path = map.find("path")) sensor.path = path_from({path, map.path("path")});
  if (const YAML::Node offset = map.find("offset")) {
    YamlMap entry(offset, map.path("offset"));
    sensor.mount_from_camera = pose_from(entry);
    entry.refuse_others();
  }
  if (const YAML::Node gimbal = map.find("gimbal")) {
    auto model = read_gimbal_model(gimbal, map.path("gimbal"));
    if (!model) throw Complaint{model.error().where + ": " + model.error().what};
    sensor.gimbal = *model;
  }
  if (const YAML::Node script = map.find("gimbal_script"))
    sensor.gimbal_script = script_from(script, map.path("gimbal_script"));
}

}  // namespace

SensorDescription sensor_from(YamlMap map) {
  SensorDescription sensor;
  read_mount(map, sensor);
  sensor.width = static_cast<int>(map.number("width", 16, 4096));
  sensor.height = static_cast<int>(map.number("height", 16, 4096));
  sensor.field_of_view = kRadians * map.number("field_of_view_deg", 5, 150);
  sensor.rate = map.number("rate", 0.1, 1000);
  const Eigen::Vector2d range = map.vector<2>("depth_range");
  sensor.nearest = range[0];
  sensor.farthest = range[1];
  if (sensor.nearest < 0 || sensor.farthest <= sensor.nearest)
    throw Complaint{"'" + map.path("depth_range") + "' is not [near, far]"};
  sensor.noise = map.number("noise", 0, 100);
  if (const YAML::Node color = map.find("color"))
    sensor.color = color_sensor_from(color, map.path("color"));
  map.refuse_others();
  return sensor;
}

}  // namespace armsreach::sim
