#include "devices/rig_actuators_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/gimbal_yaml.hpp"

namespace armsreach {
namespace {

constexpr const char* kRemedy =
    "an actuator is NAME: {kind: firmata, carries: SENSOR, port: /dev/ttyACM0, baud: 57600, pins, "
    "zero_us, us_per_degree: [pan, tilt, roll], model: {...}} or {kind: uvc, carries: SENSOR, "
    "device: /dev/video0, model: {...}}";

FirmataServos servos_from(YamlMap& map) {
  FirmataServos servos;
  map.read("port", &servos.port, "a text");
  map.read("baud", &servos.baud, "a whole number");
  map.read("pins", &servos.pins, "three whole numbers");
  map.read("zero_us", &servos.zero_us, "three numbers");
  map.read("us_per_degree", &servos.us_per_degree, "three numbers");
  const auto usable = [](double number) { return std::abs(number) <= 1e5; };  // and no NaN
  if (!std::all_of(servos.zero_us.begin(), servos.zero_us.end(), usable) ||
      !std::all_of(servos.us_per_degree.begin(), servos.us_per_degree.end(), usable))
    throw map.complaint("'zero_us' or 'us_per_degree' is out of range");
  return servos;
}

RigGimbalSpec gimbal_from(const std::string& name, YamlMap map) {
  RigGimbalSpec gimbal;
  gimbal.name = name;
  gimbal.carries = map.find("carries") ? map.text("carries") : "main";
  if (const YAML::Node model = map.find("model")) gimbal.model = gimbal_model_from({model, ""});
  std::string kind;
  map.read("kind", &kind, "firmata or uvc");
  if (kind == "firmata") {
    gimbal.driver = servos_from(map);
  } else if (kind == "uvc") {
    map.read("device", &gimbal.driver.emplace<UvcMotors>().device, "a text");
  } else {
    throw map.complaint("actuator '" + name + "' is of no known kind");
  }
  map.refuse_others();
  return gimbal;
}

void check_sensor(const RigGimbalSpec& gimbal, const RigSpec& rig, const YAML::Node& node) {
  const auto carried = [&](const auto& one) { return one.carries == gimbal.carries; };
  if (std::any_of(rig.gimbals.begin(), rig.gimbals.end(), carried))
    throw YamlComplaint(node, "two gimbals carry '" + gimbal.carries + "'");
  const auto named = [&](const RigSensorSpec& one) { return one.name == gimbal.carries; };
  if (!std::any_of(rig.sensors.begin(), rig.sensors.end(), named))
    throw YamlComplaint(node, "actuator '" + gimbal.name + "' carries '" + gimbal.carries +
                                  "', which is no sensor");
}

}  // namespace

void read_actuators(const YAML::Node& list, RigSpec& rig) {
  with_remedy(kRemedy, [&] {
    if (!list.IsMap()) throw YamlComplaint(list, "'actuators' is not a map");
    for (const auto& entry : list) {
      const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "?";
      RigGimbalSpec gimbal = gimbal_from(name, {entry.second, ""});
      check_sensor(gimbal, rig, entry.first);
      rig.gimbals.push_back(std::move(gimbal));
    }
  });
}

}  // namespace armsreach
