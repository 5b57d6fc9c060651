#include "devices/sim/color_yaml.hpp"

#include "vision/core/yaml_map.hpp"

namespace armsreach::sim {

ColorDescription color_sensor_from(const YAML::Node& node, const std::string& name) {
  if (node.IsScalar() && node.Scalar() == "clean") return kCleanColor;
  YamlMap map(node, name);
  ColorDescription color;
  color.noise = map.number("noise", 0, 50, color.noise);
  color.exposure = 1e-3 * map.number("exposure_ms", 0, 1000, 1e3 * color.exposure);
  color.exposure_lag = map.number("exposure_lag", 0, 100, color.exposure_lag);
  color.exposure_drift = map.number("exposure_drift", 0, 0.5, color.exposure_drift);
  color.white_balance_drift = map.number("white_balance_drift", 0, 0.5, color.white_balance_drift);
  color.sharpness = map.number("sharpness", 0.34, 1, color.sharpness);
  color.jpeg_quality = static_cast<int>(map.number("jpeg", 0, 100, color.jpeg_quality));
  map.refuse_others();
  return color;
}

}  // namespace armsreach::sim
