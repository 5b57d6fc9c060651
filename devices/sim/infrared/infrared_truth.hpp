// What is true of one infra-red picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "vision/core/pose.hpp"

namespace armsreach::sim {

struct MarkerTruth {
  std::string name;  // "bracelet 0", ..., "square", "thumb", "index", ...
  Eigen::Vector3d centre_in_world{0, 0, 0};
  std::vector<Eigen::Vector3d> corners_in_world;  // as in TapePiece: none of discs
  std::optional<Eigen::Vector2d> centre;          // px; none behind the camera
  std::vector<Eigen::Vector2d> corners;           // px; none where any is behind the camera
  // Of the tape that faces the camera, the share that it sees: not hidden by the hand, not beyond
  // the picture's edge. 0 of tape that faces away.
  double visible = 0;
  double incidence = 0;  // rad, between the tape's normal and the way to the camera
};

// Frames: hand and square as in hand/anatomy.hpp and worn.hpp; the bracelet's as there too, its
// origin is the wrist's centre and its y the forearm's axis.
struct InfraredTruth {
  Pose world_from_camera;
  std::optional<Pose> camera_from_hand;
  std::optional<Pose> camera_from_bracelet;
  std::optional<Pose> camera_from_square;
  std::vector<MarkerTruth> markers;
};

// {"world_from_camera": pose, "camera_from_hand": pose or null, "camera_from_bracelet",
// "camera_from_square", "markers": [{"name", "centre_in_world", "corners_in_world", "centre",
// "corners", "visible", "incidence"}]}; poses as in events.
nlohmann::json json_from_truth(const InfraredTruth& truth);

}  // namespace armsreach::sim
