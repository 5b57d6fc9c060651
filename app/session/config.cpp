#include "app/session/config.hpp"

#include <cmath>
#include <optional>
#include <set>

#include <yaml-cpp/yaml.h>

namespace armsreach::app {
namespace {

// A map of the file that knows which of its keys were asked for. The first complaint is kept.
class Section {
 public:
  Section(YAML::Node node, std::string path, std::optional<Error>* error, const std::string& where)
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

  Section section(const std::string& key) {
    return {child(key), path_ + key + ".", error_, where_};
  }

  Section item(const YAML::Node& node, const std::string& list, size_t index) const {
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

void read_pair(Section& section, const std::string& key, double* first, double* second) {
  const YAML::Node node = section.child(key);
  if (!node) return;
  if (!node.IsSequence() || node.size() != 2 || !YAML::convert<double>::decode(node[0], *first) ||
      !YAML::convert<double>::decode(node[1], *second) || !std::isfinite(*first) ||
      !std::isfinite(*second)) {
    section.complain("'" + section.path() + key + "' must be two numbers, [x, y]");
  }
}

bool is_layout(const std::string& name) { return name == "wearer" || name == "operator"; }

Action read_action(Section section) {
  Action action;
  section.read<std::int64_t>("frame", &action.frame, "a frame number, 0 or more",
                             [](const std::int64_t& n) { return n >= 0; });
  read_pair(section, "click", &action.click.x(), &action.click.y());
  section.read<std::string>(
      "view", &action.view, "live, map, top, front or side", [](const std::string& v) {
        return std::set<std::string>{"live", "map", "top", "front", "side"}.count(v) > 0;
      });
  section.read<std::string>("insert", &action.insert, "the name of a mesh");
  section.read<std::string>("layout", &action.layout, "wearer or operator", is_layout);
  if (!section.child("click") && action.layout.empty()) {
    section.complain("'" + section.path() + "' has neither click nor layout");
  }
  section.refuse_unknown();
  return action;
}

void read_tracking(Section section, TrackingConfig* tracking) {
  section.read<double>("alpha", &tracking->alpha, "between 0 (intensity) and 1 (depth)",
                       [](const double& a) { return a >= 0 && a <= 1; });
  section.read<int>("iterations", &tracking->iterations, "between 1 and 100",
                    [](const int& n) { return n >= 1 && n <= 100; });
  section.read<int>("width", &tracking->width, "80 or 160 pixels",
                    [](const int& w) { return w == 80 || w == 160; });
  section.refuse_unknown();
}

void read_mapping(Section section, MappingConfig* mapping) {
  section.read<bool>("enabled", &mapping->enabled, "true or false");
  section.read<double>("resolution", &mapping->resolution, "between 0.002 and 0.2 metres",
                       [](const double& r) { return r >= 0.002 && r <= 0.2; });
  section.refuse_unknown();
}

void read_speech(Section section, SpeechConfig* speech) {
  section.read<std::string>("voice", &speech->voice, "auto, off or the name of a .wav file",
                            [](const std::string& voice) {
                              return voice == "auto" || voice == "off" ||
                                     (voice.size() > 4 && voice.ends_with(".wav"));
                            });
  section.refuse_unknown();
}

void read_size(Section& root, Config* config) {
  if (!root.child("size")) return;
  double width = 0;
  double height = 0;
  read_pair(root, "size", &width, &height);
  const auto is_side = [](double side) {
    return side >= 64 && side <= 7680 && side == std::floor(side);
  };
  if (!is_side(width) || !is_side(height)) {
    root.complain("'size' must be two whole numbers of pixels from 64 to 7680");
    return;
  }
  config->width = static_cast<int>(width);
  config->height = static_cast<int>(height);
}

void read_root(Section root, Config* config) {
  root.read<std::string>("layout", &config->layout, "wearer or operator", is_layout);
  read_size(root, config);
  root.read<bool>("threads", &config->threads, "true or false");
  root.read<int>("lag", &config->lag, "between 1 and 30 frames",
                 [](const int& n) { return n >= 1 && n <= 30; });
  read_tracking(root.section("tracking"), &config->tracking);
  read_mapping(root.section("mapping"), &config->mapping);
  read_speech(root.section("speech"), &config->speech);
  const YAML::Node actions = root.child("actions");
  if (actions && !actions.IsSequence()) root.complain("'actions' must be a list");
  if (actions && actions.IsSequence()) {
    for (size_t i = 0; i < actions.size(); ++i) {
      config->actions.push_back(read_action(root.item(actions[i], "actions", i)));
    }
  }
  root.refuse_unknown();
}

}  // namespace

Result<Config> read_config(std::istream& in, const std::string& where) {
  Config config;
  std::optional<Error> error;
  try {
    read_root(Section(YAML::Load(in), "", &error, where), &config);
  } catch (const YAML::Exception& e) {
    return Error{"not readable as YAML: " + std::string(e.what()), where,
                 "see 'Configuration' in the README"};
  }
  if (error) return *error;
  return config;
}

}  // namespace armsreach::app
