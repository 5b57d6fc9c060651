// Where a source's camera model comes from: --camera, the recording's own file, or a stated guess.
#pragma once

#include <filesystem>
#include <string>

#include "devices/open.hpp"
#include "vision/core/camera.hpp"
#include "vision/core/camera_yaml.hpp"
#include "vision/core/event.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

Result<CameraFile> read_camera_file(const std::filesystem::path& file);

// A pinhole in the image's middle with a horizontal field of view of 60 deg, between a webcam's
// (50-80 deg) and a Kinect's (57 deg).
Camera guessed_camera(int width, int height);

struct Calibration {
  Camera camera;
  Events events;  // says so where the camera is a guess
};
// For a source that is usable uncalibrated: --camera, else `file` where it exists, else a guess for
// images of this size. `component` names the source in the event.
Result<Calibration> calibration_or_guess(const OpenOptions& options,
                                         const std::filesystem::path& file, int width, int height,
                                         const std::string& component);

}  // namespace armsreach
