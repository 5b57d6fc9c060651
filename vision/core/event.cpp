#include "vision/core/event.hpp"

#include <nlohmann/json.hpp>

namespace armsreach {
namespace {

using nlohmann::json;

json json_from_pose(const Pose& pose) {
  const Eigen::Vector3d& t = pose.translation();
  const Eigen::Quaterniond& q = pose.rotation();
  return {{"translation", {t.x(), t.y(), t.z()}}, {"rotation", {q.x(), q.y(), q.z(), q.w()}}};
}

template <class ObjectEvent>
json json_from_object(const char* type, const ObjectEvent& e) {
  return {{"type", type},
          {"object", e.object},
          {"id", e.id},
          {"world_from_object", json_from_pose(e.world_from_object)}};
}

json json_from_point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

// Where a thing is in the image, and in the world where that is known.
void put_place(json& object, const Eigen::Vector2d& pixel,
               const std::optional<Eigen::Vector3d>& point_in_world) {
  object["x"] = pixel.x();
  object["y"] = pixel.y();
  if (point_in_world) object["point_in_world"] = json_from_point(*point_in_world);
}

struct BodyToJson {
  json operator()(const TrackingEvent& e) const {
    return {{"type", "tracking"}, {"state", name(e.state)}, {"rms", e.rms}, {"inliers", e.inliers}};
  }
  json operator()(const InsertEvent& e) const { return json_from_object("insert", e); }
  json operator()(const MoveEvent& e) const { return json_from_object("move", e); }
  json operator()(const DeleteEvent& e) const { return json_from_object("delete", e); }
  json operator()(const GazeEvent& e) const {
    return {{"type", "gaze"},      {"mode", name(e.mode)}, {"pan", e.angles[0]},
            {"tilt", e.angles[1]}, {"roll", e.angles[2]},  {"target", e.target}};
  }
  json operator()(const FaultEvent& e) const {
    return {{"type", "fault"},
            {"component", e.component},
            {"message", e.message},
            {"remedy", e.remedy}};
  }
  json operator()(const GestureEvent& e) const {
    return {
        {"type", "gesture"}, {"hand", e.hand},   {"name", e.name.empty() ? json() : json(e.name)},
        {"score", e.score},  {"x", e.pixel.x()}, {"y", e.pixel.y()},
        {"angle", e.angle}};
  }
  json operator()(const HighlightEvent& e) const {
    json object = {{"type", "highlight"}, {"name", e.name}};
    put_place(object, e.pixel, e.point_in_world);
    return object;
  }
  json operator()(const LabelEvent& e) const {
    json object = {{"type", "label"}, {"text", e.text}};
    put_place(object, e.pixel, e.point_in_world);
    return object;
  }
  json operator()(const AcceptEvent& e) const {
    return {{"type", "accept"},
            {"anchor", e.anchor},
            {"point_in_world", json_from_point(e.point_in_world)}};
  }
  json operator()(const RejectEvent& e) const {
    return {{"type", "reject"},
            {"anchor", e.anchor},
            {"point_in_world", json_from_point(e.point_in_world)}};
  }
  json operator()(const SpeechEvent& e) const { return {{"type", "speech"}, {"text", e.text}}; }
};

}  // namespace

std::string_view name(TrackingState state) {
  switch (state) {
    case TrackingState::initialising:
      return "initialising";
    case TrackingState::tracking:
      return "tracking";
    case TrackingState::lost:
      return "lost";
    case TrackingState::relocalised:
      return "relocalised";
    case TrackingState::untracked:
      return "untracked";
  }
  return "";
}

std::string_view name(GazeMode mode) {
  switch (mode) {
    case GazeMode::follow:
      return "follow";
    case GazeMode::saccade:
      return "saccade";
    case GazeMode::fixate:
      return "fixate";
    case GazeMode::rest:
      return "rest";
  }
  return "";
}

json json_from_event(const Event& event) {
  json object = std::visit(BodyToJson{}, event.body);
  object["t"] = seconds_from_timestamp(event.time);
  return object;
}

}  // namespace armsreach
