#include "devices/sim/infrared/infrared_truth.hpp"

#include <nlohmann/json.hpp>

namespace armsreach::sim {
namespace {

using nlohmann::json;

json json_from(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
json json_from(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }
json json_from(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation();
  return {{"translation", json_from(pose.translation())},
          {"rotation", {q.x(), q.y(), q.z(), q.w()}}};
}
template <class T>
json json_from(const std::optional<T>& value) {
  return value ? json_from(*value) : json();
}
template <class T>
json json_from(const std::vector<T>& values) {
  json list = json::array();
  for (const T& value : values) list.push_back(json_from(value));
  return list;
}
json json_from(const MarkerTruth& marker) {
  return {{"name", marker.name},
          {"centre_in_world", json_from(marker.centre_in_world)},
          {"corners_in_world", json_from(marker.corners_in_world)},
          {"centre", json_from(marker.centre)},
          {"corners", json_from(marker.corners)},
          {"visible", marker.visible},
          {"incidence", marker.incidence}};
}

}  // namespace

json json_from_truth(const InfraredTruth& truth) {
  json markers = json::array();
  for (const MarkerTruth& marker : truth.markers) markers.push_back(json_from(marker));
  return {{"world_from_camera", json_from(truth.world_from_camera)},
          {"camera_from_hand", json_from(truth.camera_from_hand)},
          {"camera_from_bracelet", json_from(truth.camera_from_bracelet)},
          {"camera_from_square", json_from(truth.camera_from_square)},
          {"markers", markers}};
}

}  // namespace armsreach::sim
