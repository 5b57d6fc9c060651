// The configuration file: what a run can be told beyond its command line. Unknown keys are refused
// by name, so that a misspelt one is never silently ignored.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vision/core/result.hpp"

namespace armsreach::app {

// What a person's click would do, done at a frame.
struct Action {
  std::int64_t frame = 0;
  Eigen::Vector2d click{0, 0};  // px of the view
  std::string view = "live";    // live, map, top, front, side
  std::string insert;           // a mesh name; empty: select what is there
  std::string layout;           // show this layout from here on, instead of a click
};

struct TrackingConfig {
  // dense: depth (or a map that depth has left); mono: the picture alone; none; auto: dense for the
  // workspace, mono for the wearer of a plain camera.
  std::string method = "auto";
  double alpha = 0.95;  // weight of depth against intensity, 0..1
  int iterations = 0;   // at each resolution; 0: what the width needs
  int width = 80;       // px of the finest images aligned: 80 or 160
};

// Of a camera that is tracked by its picture alone.
struct MonoSlamConfig {
  std::string target;          // file of the start target; empty: the recording's, if it has one
  double stated_distance = 1;  // m, of what is seen first, where neither target nor depth says
  int visible_points = 36;     // kept in view
  int most_points = 120;       // in the map
  std::string new_points = "inverse_depth";   // or "particles"
  std::optional<int> forget_start_target_at;  // frame
};

struct MappingConfig {
  bool enabled = true;
  double resolution = 0.01;  // m
};

// Of the One Euro filter; speeds are in sizes of the hand.
struct CursorFilterConfig {
  bool enabled = true;
  double min_cutoff = 1.2;  // Hz at rest
  double beta = 1.5;        // Hz for each size of the hand a second
};

// Files and folders are empty for those that the program brings along.
struct GestureConfig {
  std::string vocabulary = "wearable";
  std::string templates;          // folder
  std::string skin;               // skin model
  std::string hands;              // what they look like, from `learn hands`
  std::string colours;            // classes of coloured things
  std::string table;              // transitions
  double window = 0.25;           // s of the modal filter
  double reach = 0.7;             // m: skin beyond is no hand, where there is depth
  std::string insert = "teapot";  // mesh that a selecting hand inserts in a map; empty: none
  CursorFilterConfig cursor_filter;
};

struct GazeConfig {
  // auto: follow where there is a gimbal; or follow, saccade, fixate, stabilise (hold the first
  // direction against the wearer's turning), rest.
  std::string mode = "auto";
  // hand, hands (their midpoint), grasp (what it points at), colour:NAME; to leap to and to hold
  // also point:ID of the sparse map and object:ID inserted.
  std::string target = "hand";
  std::optional<Eigen::Vector3d> point_in_world;  // m, in place of a target's name
};

struct ShowConfig {
  bool rings = false;  // that the hand detector looks at
};

struct SpeechConfig {
  // auto: aloud when live in a window, and on films; off; or the name of a WAV file to speak into.
  std::string voice = "auto";
};

struct Config {
  std::string layout = "wearer";  // or "operator"
  int width = 0;                  // px of the picture; 0: the video's, or 1280x720 for an operator
  int height = 0;
  bool threads = true;  // false: one loop turns every stage (only with --pace every-frame)
  int lag = 3;          // frames between a frame and the map it is tracked against, every-frame
  TrackingConfig tracking;
  MonoSlamConfig mono_slam;
  MappingConfig mapping;
  GestureConfig gesture;
  GazeConfig gaze;
  ShowConfig show;
  SpeechConfig speech;
  std::vector<Action> actions;
};

Result<Config> read_config(std::istream& in, const std::string& where);

}  // namespace armsreach::app
