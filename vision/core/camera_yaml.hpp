// Codec of camera files: the ROS camera_info YAML plus `depth_units_per_metre`, in a colour
// camera's file `camera_from_depth: {rotation_vector: [rad x3], translation: [m x3]}`, and where
// the file was calibrated `calibration: {date: YYYY-MM-DD, rms: px, images: COUNT}`.
#pragma once

#include <istream>
#include <optional>
#include <ostream>
#include <string>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

// How well a camera is known.
struct CalibrationRecord {
  std::string date;  // YYYY-MM-DD
  double rms = 0;    // px, of the reprojected corners
  int images = 0;    // that were used
};

struct CameraFile {
  Camera camera;
  std::optional<Pose> camera_from_depth;
  std::optional<CalibrationRecord> calibration = std::nullopt;
};

// `where` names the stream in errors. Missing, non-finite, non-positive sizes and focal lengths and
// unknown distortion models are errors that name the entry.
Result<CameraFile> read_camera_yaml(std::istream& in, const std::string& where);
void write_camera_yaml(std::ostream& out, const CameraFile& file);

}  // namespace armsreach
