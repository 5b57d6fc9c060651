#include "devices/rig_actuators_yaml.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "devices/gimbal_yaml.hpp"

namespace armsreach {
namespace {

constexpr const char* kRemedy =
    "an actuator is NAME: {kind: firmata, carries: SENSOR, port: /dev/ttyACM0, baud: 57600, pins, "
    "zero_us, us_per_degree: [pan, tilt, roll], model: {...}} or {kind: uvc, carries: SENSOR, "
    "device: /dev/video0, model: {...}}";

Error complaint(const YAML::Node& node, const std::string& where, const std::string& what) {
  std::string place = where;
  if (!node.Mark().is_null()) place.append(":").append(std::to_string(node.Mark().line + 1));
  return {what, place, kRemedy};
}

Status check_keys(const YAML::Node& map, const std::string& where,
                  const std::vector<std::string>& known) {
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    return complaint(entry.first, where, "unknown key '" + key + "' in an actuator");
  }
  return ok();
}

// Leaves `value` as it is where the key is not there.
template <class T>
Status read_value(const YAML::Node& map, const std::string& where, const char* key, T& value) {
  const YAML::Node node = map[key];
  try {
    if (node) value = node.as<T>();
    return ok();
  } catch (const YAML::BadConversion&) {
  }
  return complaint(node, where, std::string("'") + key + "' is not of its kind");
}

Status read_servos(const YAML::Node& map, const std::string& where, FirmataServos& servos) {
  for (const Status& status :
       {check_keys(
            map, where,
            {"kind", "carries", "port", "baud", "pins", "zero_us", "us_per_degree", "model"}),
        read_value(map, where, "port", servos.port), read_value(map, where, "baud", servos.baud),
        read_value(map, where, "pins", servos.pins),
        read_value(map, where, "zero_us", servos.zero_us),
        read_value(map, where, "us_per_degree", servos.us_per_degree)}) {
    if (!status) return status;
  }
  const auto usable = [](double number) { return std::abs(number) <= 1e5; };  // and no NaN
  const bool good = std::all_of(servos.zero_us.begin(), servos.zero_us.end(), usable) &&
                    std::all_of(servos.us_per_degree.begin(), servos.us_per_degree.end(), usable);
  return good ? ok() : complaint(map, where, "'zero_us' or 'us_per_degree' is out of range");
}

Status read_motors(const YAML::Node& map, const std::string& where, UvcMotors& motors) {
  if (auto keys = check_keys(map, where, {"kind", "carries", "device", "model"}); !keys)
    return keys;
  return read_value(map, where, "device", motors.device);
}

Result<RigGimbalSpec> read_gimbal(const std::string& name, const YAML::Node& map,
                                  const std::string& where) {
  RigGimbalSpec gimbal;
  gimbal.name = name;
  gimbal.carries = "main";
  std::string kind;
  if (auto status = read_value(map, where, "kind", kind); !status) return status.error();
  if (auto status = read_value(map, where, "carries", gimbal.carries); !status)
    return status.error();
  if (const YAML::Node model = map["model"]) {
    auto read = read_gimbal_model(model, where);
    if (!read) return std::move(read).error();
    gimbal.model = *read;
  }
  Status status = complaint(map, where, "actuator '" + name + "' is of no known kind");
  if (kind == "firmata") status = read_servos(map, where, gimbal.driver.emplace<FirmataServos>());
  if (kind == "uvc") status = read_motors(map, where, gimbal.driver.emplace<UvcMotors>());
  if (!status) return status.error();
  return gimbal;
}

Status check_sensor(const RigGimbalSpec& gimbal, const RigSpec& rig, const YAML::Node& node,
                    const std::string& where) {
  const auto carried = [&](const auto& one) { return one.carries == gimbal.carries; };
  if (std::any_of(rig.gimbals.begin(), rig.gimbals.end(), carried))
    return complaint(node, where, "two gimbals carry '" + gimbal.carries + "'");
  const auto named = [&](const RigSensorSpec& one) { return one.name == gimbal.carries; };
  if (std::any_of(rig.sensors.begin(), rig.sensors.end(), named)) return ok();
  return complaint(
      node, where,
      "actuator '" + gimbal.name + "' carries '" + gimbal.carries + "', which is no sensor");
}

}  // namespace

Status read_actuators(const YAML::Node& map, const std::string& where, RigSpec& rig) {
  if (!map.IsMap()) return complaint(map, where, "'actuators' is not a map");
  for (const auto& entry : map) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (!entry.second.IsMap())
      return complaint(entry.first, where, "actuator '" + name + "' is not a map");
    auto gimbal = read_gimbal(name, entry.second, where);
    if (!gimbal) return std::move(gimbal).error();
    if (auto status = check_sensor(*gimbal, rig, entry.first, where); !status) return status;
    rig.gimbals.push_back(std::move(*gimbal));
  }
  return ok();
}

}  // namespace armsreach
