#include "app/session/config.hpp"

#include <cmath>
#include <set>

#include "vision/core/yaml_map.hpp"

namespace armsreach::app {
namespace {

void read_pair(YamlMap& section, const std::string& key, double* first, double* second) {
  const YAML::Node node = section.find(key);
  if (!node) return;
  if (!node.IsSequence() || node.size() != 2 || !YAML::convert<double>::decode(node[0], *first) ||
      !YAML::convert<double>::decode(node[1], *second) || !std::isfinite(*first) ||
      !std::isfinite(*second)) {
    throw section.complaint(key, "must be two numbers, [x, y]");
  }
}

bool is_layout(const std::string& name) { return name == "wearer" || name == "operator"; }

Action read_action(YamlMap section) {
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
  if (!section.find("click") && action.layout.empty()) {
    throw section.complaint("", "has neither click nor layout");
  }
  section.refuse_others();
  return action;
}

bool is_one_of(const std::string& text, const std::set<std::string>& names) {
  return names.count(text) > 0;
}

void read_tracking(YamlMap section, TrackingConfig* tracking) {
  section.read<std::string>("method", &tracking->method, "auto, dense, mono or none",
                            [](const std::string& m) {
                              return is_one_of(m, {"auto", "dense", "mono", "none"});
                            });
  section.read<double>("alpha", &tracking->alpha, "between 0 (intensity) and 1 (depth)",
                       [](const double& a) { return a >= 0 && a <= 1; });
  section.read<int>("iterations", &tracking->iterations, "between 1 and 100",
                    [](const int& n) { return n >= 1 && n <= 100; });
  section.read<int>("width", &tracking->width, "80 or 160 pixels",
                    [](const int& w) { return w == 80 || w == 160; });
  section.refuse_others();
}

void read_mono_slam(YamlMap section, MonoSlamConfig* mono) {
  section.read<std::string>("target", &mono->target, "a file of a start target",
                            [](const std::string& file) { return !file.empty(); });
  section.read<double>("stated_distance", &mono->stated_distance, "between 0.05 and 100 metres",
                       [](const double& d) { return d >= 0.05 && d <= 100; });
  section.read<int>("visible_points", &mono->visible_points, "between 8 and 60",
                    [](const int& n) { return n >= 8 && n <= 60; });
  section.read<int>("most_points", &mono->most_points, "between 16 and 400",
                    [](const int& n) { return n >= 16 && n <= 400; });
  section.read<std::string>("new_points", &mono->new_points, "particles or inverse_depth",
                            [](const std::string& n) {
                              return is_one_of(n, {"particles", "inverse_depth"});
                            });
  int frame = 0;
  section.read<int>("forget_start_target_at", &frame, "a frame number, 1 or more",
                    [](const int& n) { return n >= 1; });
  if (frame > 0) mono->forget_start_target_at = frame;
  if (mono->visible_points > mono->most_points)
    throw section.complaint("visible_points", "must not exceed most_points");
  section.refuse_others();
}

void read_mapping(YamlMap section, MappingConfig* mapping) {
  section.read<bool>("enabled", &mapping->enabled, "true or false");
  section.read<double>("resolution", &mapping->resolution, "between 0.002 and 0.2 metres",
                       [](const double& r) { return r >= 0.002 && r <= 0.2; });
  section.refuse_others();
}

bool is_filled(const std::string& text) { return !text.empty(); }

void read_cursor_filter(YamlMap section, CursorFilterConfig* filter) {
  section.read<bool>("enabled", &filter->enabled, "true or false");
  section.read<double>("min_cutoff", &filter->min_cutoff, "between 0.01 and 100 Hz",
                       [](const double& f) { return f >= 0.01 && f <= 100; });
  section.read<double>("beta", &filter->beta, "between 0 and 100",
                       [](const double& b) { return b >= 0 && b <= 100; });
  section.refuse_others();
}

void read_gesture(YamlMap section, GestureConfig* gesture) {
  section.read<std::string>("vocabulary", &gesture->vocabulary, "the name of a vocabulary",
                            is_filled);
  section.read<std::string>("templates", &gesture->templates, "a folder of templates", is_filled);
  section.read<std::string>("skin", &gesture->skin, "a file of a skin model", is_filled);
  section.read<std::string>("hands", &gesture->hands, "a file of what hands look like", is_filled);
  section.read<std::string>("colours", &gesture->colours, "a file of colour classes", is_filled);
  section.read<std::string>("table", &gesture->table, "a file of transitions", is_filled);
  section.read<double>("window", &gesture->window, "between 0 and 2 seconds",
                       [](const double& w) { return w >= 0 && w <= 2; });
  section.read<double>("reach", &gesture->reach, "between 0.1 and 10 metres",
                       [](const double& r) { return r >= 0.1 && r <= 10; });
  section.read<std::string>("insert", &gesture->insert, "the name of a mesh, or ''");
  read_cursor_filter(section.section("cursor_filter"), &gesture->cursor_filter);
  section.refuse_others();
}

bool has_prefix(const std::string& text, const std::string& prefix) {
  return text.size() > prefix.size() && text.rfind(prefix, 0) == 0;
}

bool has_number(const std::string& text, const std::string& prefix) {
  return has_prefix(text, prefix) && text.size() < prefix.size() + 10 &&
         text.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
}

bool is_seen_target(const std::string& target) {
  return is_one_of(target, {"hand", "hands", "grasp"}) || has_prefix(target, "colour:");
}

void read_gaze_target(YamlMap& section, GazeConfig* gaze) {
  const YAML::Node node = section.find("target");
  if (!node) return;
  std::vector<double> point;
  if (node.IsSequence() && YAML::convert<std::vector<double>>::decode(node, point) &&
      point.size() == 3) {
    gaze->point_in_world = Eigen::Vector3d(point[0], point[1], point[2]);
    if (gaze->point_in_world->allFinite()) return;
  } else if (node.IsScalar()) {
    gaze->target = node.Scalar();
    if (is_seen_target(gaze->target) || has_number(gaze->target, "point:") ||
        has_number(gaze->target, "object:"))
      return;
  }
  throw section.complaint("target",
                          "must be hand, hands, grasp, colour:NAME, point:ID, object:ID or a "
                          "point in the world, [x, y, z]");
}

void read_gaze(YamlMap section, GazeConfig* gaze) {
  section.read<std::string>(
      "mode", &gaze->mode, "auto, follow, saccade, fixate, stabilise or rest",
      [](const std::string& m) {
        return is_one_of(m, {"auto", "follow", "saccade", "fixate", "stabilise", "rest"});
      });
  read_gaze_target(section, gaze);
  const bool follows = gaze->mode == "auto" || gaze->mode == "follow";
  if (follows && (gaze->point_in_world || !is_seen_target(gaze->target)))
    throw section.complaint("mode", "must be saccade or fixate for a point");
  if (gaze->mode == "stabilise" && section.find("target"))
    throw section.complaint("mode", "stabilise holds a direction: leave out target");
  section.refuse_others();
}

void read_show(YamlMap section, ShowConfig* show) {
  section.read<bool>("rings", &show->rings, "true or false");
  section.refuse_others();
}

void read_speech(YamlMap section, SpeechConfig* speech) {
  section.read<std::string>("voice", &speech->voice, "auto, off or the name of a .wav file",
                            [](const std::string& voice) {
                              return voice == "auto" || voice == "off" ||
                                     (voice.size() > 4 && voice.ends_with(".wav"));
                            });
  section.refuse_others();
}

void read_size(YamlMap& root, Config* config) {
  if (!root.find("size")) return;
  double width = 0;
  double height = 0;
  read_pair(root, "size", &width, &height);
  const auto is_side = [](double side) {
    return side >= 64 && side <= 7680 && side == std::floor(side);
  };
  if (!is_side(width) || !is_side(height))
    throw root.complaint("size", "must be two whole numbers of pixels from 64 to 7680");
  config->width = static_cast<int>(width);
  config->height = static_cast<int>(height);
}

Config config_from(const YAML::Node& node) {
  YamlMap root(node, "");
  Config config;
  root.read<std::string>("layout", &config.layout, "wearer or operator", is_layout);
  read_size(root, &config);
  root.read<bool>("threads", &config.threads, "true or false");
  root.read<int>("lag", &config.lag, "between 1 and 30 frames",
                 [](const int& n) { return n >= 1 && n <= 30; });
  read_tracking(root.section("tracking"), &config.tracking);
  read_mono_slam(root.section("mono_slam"), &config.mono_slam);
  read_mapping(root.section("mapping"), &config.mapping);
  read_gesture(root.section("gesture"), &config.gesture);
  read_gaze(root.section("gaze"), &config.gaze);
  read_show(root.section("show"), &config.show);
  read_speech(root.section("speech"), &config.speech);
  if (root.find("actions")) {
    for (const YamlMap& entry : root.items("actions")) config.actions.push_back(read_action(entry));
  }
  root.refuse_others();
  return config;
}

}  // namespace

Result<Config> read_config(std::istream& in, const std::string& where) {
  return read_yaml(in, where, "see 'Configuration' in the README", config_from);
}

}  // namespace armsreach::app
