// `tum:DIR`: recordings in the layout of the TUM RGB-D benchmark.
//
//   rgb.txt, depth.txt    time file (either may be missing)
//   associations.txt      time colour time depth; without it images are paired by nearest time
//   camera.yaml           the depth camera's where there is depth, else the colour camera's
//   camera_color.yaml     the colour camera's, with camera_from_depth, where the two differ;
//   without
//                         it they are taken to coincide (SensorInfo::registration_stated)
//   groundtruth.txt       time tx ty tz qx qy qz qw, world from depth camera (may be missing)
//   truth.jsonl           all that is true of each frame (truth_json.hpp), of simulated sensors; it
//                         names the images in masks/ and true_depth/
//
// Lists and calibration are checked when opening, images when reading them.
#pragma once

#include <filesystem>
#include <memory>

#include "devices/open.hpp"
#include "devices/recording.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

// `options.camera` takes the place of camera.yaml, or of camera_color.yaml when it has
// camera_from_depth.
Result<std::unique_ptr<Recording>> open_tum_recording(const std::filesystem::path& folder,
                                                      const OpenOptions& options);

}  // namespace armsreach
