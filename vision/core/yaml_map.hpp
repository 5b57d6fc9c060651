// Reading YAML files: every entry of a map is asked for by name, and what is missing, of the wrong
// kind or unknown is complained about by its path and its line.
#pragma once

#include <functional>
#include <istream>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

#include "vision/core/result.hpp"

namespace armsreach {

// Travels as an exception inside the readers, as yaml-cpp's own do, and leaves them as an Error.
struct YamlComplaint {
  explicit YamlComplaint(const std::string& what_is_wrong) : what(what_is_wrong) {}
  YamlComplaint(const YAML::Node& node, const std::string& what_is_wrong);

  std::string what;
  int line = 0;        // from 1; 0 where it is not known
  std::string remedy;  // of a part that has one of its own
};

// What `read` makes of the file's root; `where` names the stream in errors.
template <class Read>
Result<std::invoke_result_t<Read, YAML::Node>> read_yaml(std::istream& in, const std::string& where,
                                                         const std::string& remedy, Read read) {
  try {
    return read(YAML::Load(in));
  } catch (const YamlComplaint& complaint) {
    const std::string line = complaint.line ? ":" + std::to_string(complaint.line) : "";
    return Error{complaint.what, where + line,
                 complaint.remedy.empty() ? remedy : complaint.remedy};
  } catch (const YAML::Exception& e) {
    return Error{"not readable as YAML: " + std::string(e.what()), where, remedy};
  }
}

// Of a part of a file: complaints that have no remedy get this one.
template <class Read>
auto with_remedy(const std::string& remedy, Read read) {
  try {
    return read();
  } catch (YamlComplaint& complaint) {
    if (complaint.remedy.empty()) complaint.remedy = remedy;
    throw;
  }
}

double number_from(const YAML::Node& node, const std::string& key);
std::vector<double> numbers_from(const YAML::Node& node, const std::string& key);
template <int N>
Eigen::Matrix<double, N, 1> vector_from(const YAML::Node& node, const std::string& key) {
  const std::vector<double> values = numbers_from(node, key);
  if (values.size() != N)
    throw YamlComplaint(node, "'" + key + "' has not " + std::to_string(N) + " numbers");
  return Eigen::Matrix<double, N, 1>(values.data());
}
// "#rrggbb" as red, green, blue in 0..1.
Eigen::Vector3d color_from(const YAML::Node& node, const std::string& key);

// One map of the file; remembers which keys were asked for, so that the others can be refused.
class YamlMap {
 public:
  // A node that is empty or not there is a map without entries.
  YamlMap(const YAML::Node& node, const std::string& name);

  // Of an entry; of the map itself with no key.
  std::string path(const std::string& key) const {
    return name_ + (name_.empty() || key.empty() ? "" : ".") + key;
  }
  // "'path.key' ...", on the line of that entry or, where it is missing, of the map.
  YamlComplaint complaint(const std::string& key, const std::string& what) const;
  // About the map as a whole.
  YamlComplaint complaint(const std::string& what) const { return {node_, what}; }

  // Of a map whose keys are easily misspelt: others are refused before these are asked for.
  void expect(const std::set<std::string>& keys);
  // Refuses what was not asked for.
  void refuse_others() const;

  // Null when it is not there.
  YAML::Node find(const std::string& key);
  YAML::Node need(const std::string& key);
  YamlMap section(const std::string& key) { return {find(key), path(key)}; }
  // A list of maps.
  std::vector<YamlMap> items(const std::string& key);

  // Leaves `value` as it is where the key is not there; `meaning` completes "must be".
  template <class T>
  void read(const std::string& key, T* value, const std::string& meaning,
            const std::function<bool(const T&)>& valid = nullptr) {
    const YAML::Node node = find(key);
    if (!node) return;
    T read{};
    bool good = false;
    try {
      good = YAML::convert<T>::decode(node, read) && (!valid || valid(read));
    } catch (const YAML::BadConversion&) {  // of something within
    }
    if (!good) throw complaint(key, "must be " + meaning);
    *value = read;
  }
  double number(const std::string& key, double low, double high,
                std::optional<double> fallback = std::nullopt);
  bool flag(const std::string& key);
  std::string text(const std::string& key);  // that is not empty
  Eigen::Vector3d color(const std::string& key) { return color_from(need(key), path(key)); }
  template <int N>
  Eigen::Matrix<double, N, 1> vector(const std::string& key) {
    return vector_from<N>(need(key), path(key));
  }
  // Sizes of a shape.
  template <int N>
  Eigen::Matrix<double, N, 1> lengths(const std::string& key) {
    const Eigen::Matrix<double, N, 1> values = vector<N>(key);
    if (values.minCoeff() <= 0) throw complaint(key, "has a size of zero or less");
    return values;
  }

 private:
  YAML::Node node_;
  std::string name_;
  std::set<std::string> asked_;
};

}  // namespace armsreach
