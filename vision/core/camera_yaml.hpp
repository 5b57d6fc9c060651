// Codec of camera files: the ROS camera_info YAML plus `depth_units_per_metre`, and in a colour
// camera's file `camera_from_depth: {rotation_vector: [rad x3], translation: [m x3]}`.
#pragma once

#include <istream>
#include <optional>
#include <ostream>
#include <string>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

struct CameraFile {
  Camera camera;
  std::optional<Pose> camera_from_depth;
};

// `where` names the stream in errors. Missing, non-finite, non-positive sizes and focal lengths and
// unknown distortion models are errors that name the entry.
Result<CameraFile> read_camera_yaml(std::istream& in, const std::string& where);
void write_camera_yaml(std::ostream& out, const CameraFile& file);

}  // namespace armsreach
