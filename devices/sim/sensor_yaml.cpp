#include <numbers>

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
  throw map.complaint("mount", "is neither path, head nor shoulder");
}

std::vector<GimbalCommand> script_from(const std::vector<YamlMap>& entries) {
  std::vector<GimbalCommand> script;
  for (YamlMap entry : entries) {
    GimbalCommand command;
    command.time = timestamp_from_seconds(entry.number("t", 0, 3600));
    command.angles = kRadians * entry.vector<3>("angles_deg");
    entry.refuse_others();
    if (!script.empty() && command.time <= script.back().time)
      throw entry.complaint("the times of 'gimbal_script' do not increase");
    script.push_back(command);
  }
  return script;
}

void read_mount(YamlMap& map, SensorDescription& sensor) {
  sensor.mount = mount_from(map);
  if (map.find("path")) sensor.path = path_from(map.section("path"));
  if (map.find("offset")) {
    YamlMap entry = map.section("offset");
    sensor.mount_from_camera = pose_from(entry);
    entry.refuse_others();
  }
  if (map.find("gimbal")) sensor.gimbal = gimbal_model_from(map.section("gimbal"));
  if (map.find("gimbal_script")) sensor.gimbal_script = script_from(map.items("gimbal_script"));
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
    throw map.complaint("depth_range", "is not [near, far]");
  sensor.noise = map.number("noise", 0, 100);
  if (const YAML::Node color = map.find("color"))
    sensor.color = color_sensor_from(color, map.path("color"));
  map.refuse_others();
  return sensor;
}

}  // namespace armsreach::sim
