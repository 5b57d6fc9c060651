// `camera:N`: /dev/videoN through Video4Linux.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "devices/open.hpp"
#include "devices/source.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

Result<std::unique_ptr<Source>> open_v4l2_camera(const SourceSpec& spec,
                                                 const OpenOptions& options);

// One line a capture device in `folder`, or one that says why there is none.
std::vector<Availability> probe_v4l2(const std::filesystem::path& folder = "/dev");

}  // namespace armsreach
