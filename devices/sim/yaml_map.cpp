#include "devices/sim/yaml_map.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace armsreach::sim {

double number_from(const YAML::Node& node, const std::string& key) {
  double value = 0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
    throw Complaint{"'" + key + "' is not a finite number"};
  return value;
}

std::vector<double> numbers_from(const YAML::Node& node, const std::string& key) {
  if (!node.IsSequence()) throw Complaint{"'" + key + "' is not a list of numbers"};
  std::vector<double> values;
  for (const YAML::Node& item : node) values.push_back(number_from(item, key));
  return values;
}

Eigen::Vector3d color_from(const YAML::Node& node, const std::string& key) {
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  const bool hexadecimal =
      text.size() == 7 && text[0] == '#' &&
      std::all_of(text.begin() + 1, text.end(), [](unsigned char c) { return std::isxdigit(c); });
  if (!hexadecimal) throw Complaint{"'" + key + "' is not a colour such as \"#c08040\""};
  const auto part = [&text](std::size_t at) { return std::stoi(text.substr(at, 2), nullptr, 16); };
  return Eigen::Vector3d(part(1), part(3), part(5)) / 255.0;
}

YamlMap::YamlMap(const YAML::Node& node, std::string name) : node_(node), name_(std::move(name)) {
  if (!node_.IsMap()) throw Complaint{"'" + name_ + "' is not a map"};
}

YAML::Node YamlMap::find(const std::string& key) {
  asked_.push_back(key);
  return node_[key];
}

YAML::Node YamlMap::need(const std::string& key) {
  YAML::Node node = find(key);
  if (!node) throw Complaint{"'" + path(key) + "' is missing"};
  return node;
}

double YamlMap::number(const std::string& key, double low, double high,
                       std::optional<double> fallback) {
  const YAML::Node node = fallback ? find(key) : need(key);
  if (!node) return *fallback;
  const double value = number_from(node, path(key));
  if (value < low || value > high)
    throw Complaint{"'" + path(key) + "' is not from " + YAML::Dump(YAML::Node(low)) + " to " +
                    YAML::Dump(YAML::Node(high))};
  return value;
}

bool YamlMap::flag(const std::string& key) {
  const YAML::Node node = find(key);
  bool value = false;
  if (node && !YAML::convert<bool>::decode(node, value))
    throw Complaint{"'" + path(key) + "' is neither true nor false"};
  return value;
}

std::string YamlMap::text(const std::string& key) {
  const YAML::Node node = need(key);
  if (!node.IsScalar()) throw Complaint{"'" + path(key) + "' is not a text"};
  return node.Scalar();
}

void YamlMap::refuse_others() const {
  for (const auto& entry : node_) {
    const std::string key = entry.first.Scalar();
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
      throw Complaint{"unknown key '" + path(key) + "'"};
  }
}

}  // namespace armsreach::sim
