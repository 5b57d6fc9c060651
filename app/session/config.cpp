#include "app/session/config.hpp"

#include <cmath>
#include <optional>
#include <set>

#include <yaml-cpp/yaml.h>

#include "app/session/yaml_section.hpp"

namespace armsreach::app {
namespace {

void read_pair(YamlSection& section, const std::string& key, double* first, double* second) {
  const YAML::Node node = section.child(key);
  if (!node) return;
  if (!node.IsSequence() || node.size() != 2 || !YAML::convert<double>::decode(node[0], *first) ||
      !YAML::convert<double>::decode(node[1], *second) || !std::isfinite(*first) ||
      !std::isfinite(*second)) {
    section.complain("'" + section.path() + key + "' must be two numbers, [x, y]");
  }
}

bool is_layout(const std::string& name) { return name == "wearer" || name == "operator"; }

Action read_action(YamlSection section) {
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

void read_tracking(YamlSection section, TrackingConfig* tracking) {
  section.read<double>("alpha", &tracking->alpha, "between 0 (intensity) and 1 (depth)",
                       [](const double& a) { return a >= 0 && a <= 1; });
  section.read<int>("iterations", &tracking->iterations, "between 1 and 100",
                    [](const int& n) { return n >= 1 && n <= 100; });
  section.read<int>("width", &tracking->width, "80 or 160 pixels",
                    [](const int& w) { return w == 80 || w == 160; });
  section.refuse_unknown();
}

void read_mapping(YamlSection section, MappingConfig* mapping) {
  section.read<bool>("enabled", &mapping->enabled, "true or false");
  section.read<double>("resolution", &mapping->resolution, "between 0.002 and 0.2 metres",
                       [](const double& r) { return r >= 0.002 && r <= 0.2; });
  section.refuse_unknown();
}

bool is_filled(const std::string& text) { return !text.empty(); }

void read_cursor_filter(YamlSection section, CursorFilterConfig* filter) {
  section.read<bool>("enabled", &filter->enabled, "true or false");
  section.read<double>("min_cutoff", &filter->min_cutoff, "between 0.01 and 100 Hz",
                       [](const double& f) { return f >= 0.01 && f <= 100; });
  section.read<double>("beta", &filter->beta, "between 0 and 100",
                       [](const double& b) { return b >= 0 && b <= 100; });
  section.refuse_unknown();
}

void read_gesture(YamlSection section, GestureConfig* gesture) {
  section.read<std::string>("vocabulary", &gesture->vocabulary, "the name of a vocabulary",
                            is_filled);
  section.read<std::string>("templates", &gesture->templates, "a folder of templates", is_filled);
  section.read<std::string>("skin", &gesture->skin, "a file of a skin model", is_filled);
  section.read<std::string>("colours", &gesture->colours, "a file of colour classes", is_filled);
  section.read<std::string>("table", &gesture->table, "a file of transitions", is_filled);
  section.read<double>("window", &gesture->window, "between 0 and 2 seconds",
                       [](const double& w) { return w >= 0 && w <= 2; });
  section.read<double>("reach", &gesture->reach, "between 0.1 and 10 metres",
                       [](const double& r) { return r >= 0.1 && r <= 10; });
  section.read<std::string>("insert", &gesture->insert, "the name of a mesh, or ''");
  read_cursor_filter(section.section("cursor_filter"), &gesture->cursor_filter);
  section.refuse_unknown();
}

bool is_gaze_target(const std::string& target) {
  return target == "hand" || target == "hands" || target == "grasp" ||
         (target.rfind("colour:", 0) == 0 && target.size() > 7);
}

void read_gaze(YamlSection section, GazeConfig* gaze) {
  section.read<std::string>("mode", &gaze->mode, "auto, follow or rest", [](const std::string& m) {
    return m == "auto" || m == "follow" || m == "rest";
  });
  section.read<std::string>("target", &gaze->target, "hand, hands, grasp or colour:NAME",
                            is_gaze_target);
  section.refuse_unknown();
}

void read_show(YamlSection section, ShowConfig* show) {
  section.read<bool>("rings", &show->rings, "true or false");
  section.refuse_unknown();
}

void read_speech(YamlSection section, SpeechConfig* speech) {
  section.read<std::string>("voice", &speech->voice, "auto, off or the name of a .wav file",
                            [](const std::string& voice) {
                              return voice == "auto" || voice == "off" ||
                                     (voice.size() > 4 && voice.ends_with(".wav"));
                            });
  section.refuse_unknown();
}

void read_size(YamlSection& root, Config* config) {
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

void read_root(YamlSection root, Config* config) {
  root.read<std::string>("layout", &config->layout, "wearer or operator", is_layout);
  read_size(root, config);
  root.read<bool>("threads", &config->threads, "true or false");
  root.read<int>("lag", &config->lag, "between 1 and 30 frames",
                 [](const int& n) { return n >= 1 && n <= 30; });
  read_tracking(root.section("tracking"), &config->tracking);
  read_mapping(root.section("mapping"), &config->mapping);
  read_gesture(root.section("gesture"), &config->gesture);
  read_gaze(root.section("gaze"), &config->gaze);
  read_show(root.section("show"), &config->show);
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
    read_root(YamlSection(YAML::Load(in), "", &error, where), &config);
  } catch (const YAML::Exception& e) {
    return Error{"not readable as YAML: " + std::string(e.what()), where,
                 "see 'Configuration' in the README"};
  }
  if (error) return *error;
  return config;
}

}  // namespace armsreach::app
