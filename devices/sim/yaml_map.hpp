// Reading maps of YAML files: every entry is asked for by name, what is missing, of the wrong kind
// or unknown is complained about by its path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

namespace armsreach::sim {

// Complaints travel as exceptions inside the readers, as yaml-cpp's own do, and leave them as
// Errors.
struct Complaint {
  std::string what;
};

double number_from(const YAML::Node& node, const std::string& key);
std::vector<double> numbers_from(const YAML::Node& node, const std::string& key);
// "#rrggbb" as red, green, blue in 0..1.
Eigen::Vector3d color_from(const YAML::Node& node, const std::string& key);

// One map of the file; remembers which keys were asked for, so that the others can be refused.
class YamlMap {
 public:
  YamlMap(const YAML::Node& node, std::string name);

  std::string path(const std::string& key) const { return name_.empty() ? key : name_ + "." + key; }

  // Null when it is not there.
  YAML::Node find(const std::string& key);
  YAML::Node need(const std::string& key);

  double number(const std::string& key, double low, double high,
                std::optional<double> fallback = std::nullopt);
  bool flag(const std::string& key);
  std::string text(const std::string& key);
  Eigen::Vector3d color(const std::string& key) { return color_from(need(key), path(key)); }
  template <int N>
  Eigen::Matrix<double, N, 1> vector(const std::string& key) {
    const std::vector<double> values = numbers_from(need(key), path(key));
    if (values.size() != N)
      throw Complaint{"'" + path(key) + "' has not " + std::to_string(N) + " numbers"};
    return Eigen::Matrix<double, N, 1>(values.data());
  }
  // Sizes of a shape.
  template <int N>
  Eigen::Matrix<double, N, 1> lengths(const std::string& key) {
    const Eigen::Matrix<double, N, 1> values = vector<N>(key);
    if (values.minCoeff() <= 0) throw Complaint{"'" + path(key) + "' has a size of zero or less"};
    return values;
  }

  void refuse_others() const;

 private:
  YAML::Node node_;
  std::string name_;
  std::vector<std::string> asked_;
};

}  // namespace armsreach::sim
