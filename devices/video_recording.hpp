// `video:FILE`: whatever FFmpeg decodes, at its own rate, with camera.yaml beside the file where
// there is one.
#pragma once

#include <filesystem>
#include <memory>

#include "devices/open.hpp"
#include "devices/recording.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

Result<std::unique_ptr<Recording>> open_video_recording(const std::filesystem::path& file,
                                                        const OpenOptions& options);

// Whether this machine's OpenCV reads videos.
Availability probe_video();

}  // namespace armsreach
