// Events: what the program has to say, one JSON object a line. Every fallback is an event.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "vision/core/pose.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

enum class TrackingState {
  initialising,
  tracking,
  lost,
  relocalised,
  untracked,  // nobody asks where the camera is
};
std::string_view name(TrackingState state);

struct TrackingEvent {
  TrackingState state;
  double rms;   // of the weighted residuals, in units of their robust scale
  int inliers;  // pixels
};

struct InsertEvent {
  std::string object;  // mesh name
  std::int64_t id;
  Pose world_from_object;
};
struct MoveEvent {
  std::string object;
  std::int64_t id;
  Pose world_from_object;
};
struct DeleteEvent {
  std::string object;
  std::int64_t id;
  Pose world_from_object;  // where it last stood
};

// A hand has changed what it shows.
struct GestureEvent {
  int hand;
  std::string name;       // empty: nothing that can be told
  double score;           // g, -1..1
  Eigen::Vector2d pixel;  // the hand's centre
  double angle;           // rad, 0 upright, clockwise
};
// A hand points at something it did not point at before.
struct HighlightEvent {
  std::string name;
  Eigen::Vector2d pixel;
  std::optional<Eigen::Vector3d> point_in_world;
};
// Something has been recognised and named.
struct LabelEvent {
  std::string text;
  Eigen::Vector2d pixel;
  std::optional<Eigen::Vector3d> point_in_world;
};
// What the wearer says to an object just inserted or selected.
struct AcceptEvent {
  std::int64_t anchor;  // id of the object
  Eigen::Vector3d point_in_world;
};
struct RejectEvent {
  std::int64_t anchor;
  Eigen::Vector3d point_in_world;
};

enum class GazeMode { follow, saccade, fixate, rest };
std::string_view name(GazeMode mode);

// The camera on its gimbal begins to follow, to leap, to hold a point, or rests.
struct GazeEvent {
  GazeMode mode;
  Eigen::Vector3d angles;  // pan, tilt and roll that it makes for; rad
  std::string target;      // what it looks at; may be empty
};

struct FaultEvent {
  std::string component;
  std::string message;
  std::string remedy;
};

// What the program said; what it was about is an event of its own.
struct SpeechEvent {
  std::string text;
};

struct Event {
  Timestamp time;
  std::variant<TrackingEvent, InsertEvent, MoveEvent, DeleteEvent, GestureEvent, HighlightEvent,
               LabelEvent, AcceptEvent, RejectEvent, GazeEvent, FaultEvent, SpeechEvent>
      body;
};
using Events = std::vector<Event>;

// {"t": seconds, "type": ..., ...}; poses are {"translation": [x,y,z], "rotation": [x,y,z,w]}.
nlohmann::json json_from_event(const Event& event);

}  // namespace armsreach
