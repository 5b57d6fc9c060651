#include "vision/core/yaml_map.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace armsreach {

YamlComplaint::YamlComplaint(const YAML::Node& node, const std::string& what_is_wrong)
    : what(what_is_wrong) {
  if (node && !node.Mark().is_null()) line = node.Mark().line + 1;
}

double number_from(const YAML::Node& node, const std::string& key) {
  double value = 0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
    throw YamlComplaint(node, "'" + key + "' is not a finite number");
  return value;
}

std::vector<double> numbers_from(const YAML::Node& node, const std::string& key) {
  if (!node.IsSequence()) throw YamlComplaint(node, "'" + key + "' is not a list of numbers");
  std::vector<double> values;
  for (const YAML::Node& item : node) values.push_back(number_from(item, key));
  return values;
}

Eigen::Vector3d color_from(const YAML::Node& node, const std::string& key) {
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  const bool hexadecimal =
      text.size() == 7 && text[0] == '#' &&
      std::all_of(text.begin() + 1, text.end(), [](unsigned char c) { return std::isxdigit(c); });
  if (!hexadecimal) throw YamlComplaint(node, "'" + key + "' is not a colour such as \"#c08040\"");
  const auto part = [&text](std::size_t at) { return std::stoi(text.substr(at, 2), nullptr, 16); };
  return Eigen::Vector3d(part(1), part(3), part(5)) / 255.0;
}

YamlMap::YamlMap(const YAML::Node& node, const std::string& name) : node_(node), name_(name) {
  if (node_ && !node_.IsNull() && !node_.IsMap())
    throw complaint((name_.empty() ? "" : "'" + name_ + "' ") + "is not a map of keys and values");
}

YamlComplaint YamlMap::complaint(const std::string& key, const std::string& what) const {
  const YAML::Node entry = node_.IsMap() ? node_[key] : node_;
  return {entry ? entry : node_, "'" + path(key) + "' " + what};
}

void YamlMap::expect(const std::set<std::string>& keys) {
  asked_ = keys;
  refuse_others();
}

YAML::Node YamlMap::find(const std::string& key) {
  asked_.insert(key);
  if (node_.IsMap()) {
    if (const YAML::Node entry = std::as_const(node_)[key]) return entry;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

YAML::Node YamlMap::need(const std::string& key) {
  YAML::Node node = find(key);
  if (!node) throw complaint(key, "is missing");
  return node;
}

std::vector<YamlMap> YamlMap::items(const std::string& key) {
  const YAML::Node list = find(key);
  if (!list.IsSequence()) throw complaint(key, "is not a list");
  std::vector<YamlMap> items;
  for (const YAML::Node& item : list)
    items.emplace_back(item, path(key) + "[" + std::to_string(items.size()) + "]");
  return items;
}

double YamlMap::number(const std::string& key, double low, double high,
                       std::optional<double> fallback) {
  const YAML::Node node = fallback ? find(key) : need(key);
  if (!node) return *fallback;
  const double value = number_from(node, path(key));
  if (value < low || value > high)
    throw complaint(
        key, "is not from " + YAML::Dump(YAML::Node(low)) + " to " + YAML::Dump(YAML::Node(high)));
  return value;
}

bool YamlMap::flag(const std::string& key) {
  const YAML::Node node = find(key);
  bool value = false;
  if (node && !YAML::convert<bool>::decode(node, value))
    throw complaint(key, "is neither true nor false");
  return value;
}

std::string YamlMap::text(const std::string& key) {
  const YAML::Node node = need(key);
  if (!node.IsScalar() || node.Scalar().empty()) throw complaint(key, "is not a text");
  return node.Scalar();
}

void YamlMap::refuse_others() const {
  if (!node_.IsMap()) return;
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (asked_.count(key)) continue;
    std::string known;
    for (const std::string& name : asked_) known += (known.empty() ? "" : ", ") + name;
    throw YamlComplaint(entry.first, "unknown key '" + path(key) + "'; known here: " + known);
  }
}

}  // namespace armsreach
