// Events: what the program has to say, one JSON object a line. Every fallback is an event.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "vision/core/pose.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

enum class TrackingState { initialising, tracking, lost, relocalised };
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
  std::variant<TrackingEvent, InsertEvent, MoveEvent, DeleteEvent, FaultEvent, SpeechEvent> body;
  std::variant<TrackingEvent, InsertEvent, MoveEvent, DeleteEvent, GazeEvent, FaultEvent> body;
};
using Events = std::vector<Event>;

// {"t": seconds, "type": ..., ...}; poses are {"translation": [x,y,z], "rotation": [x,y,z,w]}.
nlohmann::json json_from_event(const Event& event);

}  // namespace armsreach
