// Reading maps of a YAML file whose keys are all known: every one is asked for by name, and what is
// left over or of the wrong kind is complained about by its path.
#pragma once

#include <optional>
#include <set>
#include <string>

#include <yaml-cpp/yaml.h>

#include "vision/core/result.hpp"

namespace armsreach::app {

// A map of the file that knows which of its keys were asked for. The first complaint is kept.
class YamlSection {
 public:
  YamlSection(YAML::Node node, std::string path, std::optional<Error>* error,
              const std::string& where)
      : node_(std::move(node)), path_(std::move(path)), error_(error), where_(where) {
    if (node_ && !node_.IsNull() && !node_.IsMap()) complain("is not a map of keys and values");
  }

  template <class T>
  void read(const std::string& key, T* value, const std::string& meaning,
            bool (*valid)(const T&) = nullptr) {
    const YAML::Node node = child(key);
    if (!node) return;
    T read{};
    if (!YAML::convert<T>::decode(node, read) || (valid && !valid(read))) {
      complain("'" + path_ + key + "' must be " + meaning);
      return;
    }
    *value = read;
  }

  YAML::Node child(const std::string& key) {
    known_.insert(key);
    return node_.IsMap() ? node_[key] : YAML::Node(YAML::NodeType::Undefined);
  }

  YamlSection section(const std::string& key) {
    return {child(key), path_ + key + ".", error_, where_};
  }

  YamlSection item(const YAML::Node& node, const std::string& list, size_t index) const {
    return {node, path_ + list + "[" + std::to_string(index) + "].", error_, where_};
  }

  const std::string& path() const { return path_; }

  // To be called after the last read.
  void refuse_unknown() {
    if (!node_.IsMap()) return;
    for (const auto& entry : node_) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
      if (known_.count(key)) continue;
      std::string list;
      for (const std::string& name : known_) list += (list.empty() ? "" : ", ") + name;
      complain("unknown key '" + path_ + key + "'; known here: " + list);
    }
  }

  void complain(const std::string& what) {
    if (!*error_) *error_ = Error{what, where_, "see 'Configuration' in the README"};
  }

 private:
  YAML::Node node_;
  std::string path_;
  std::optional<Error>* error_;
  const std::string& where_;
  std::set<std::string> known_;
};

}  // namespace armsreach::app
