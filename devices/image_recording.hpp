// `images:DIR[,rate=30]`: a folder of images in name order, from DIR/frames where that exists, with
// DIR/camera.yaml where there is one.
#pragma once

#include <filesystem>
#include <memory>

#include "devices/open.hpp"
#include "devices/recording.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

// `rate` in Hz. Images that differ in size from the camera's (or from the first, where the camera
// is a guess) are errors when read.
Result<std::unique_ptr<Recording>> open_image_recording(const std::filesystem::path& folder,
                                                        double rate, const OpenOptions& options);

}  // namespace armsreach
