// A camera in a binary file.
#pragma once

#include <optional>
#include <ostream>

#include "vision/core/byte_stream.hpp"
#include "vision/core/camera.hpp"

namespace armsreach {

void write_camera(std::ostream& out, const Camera& camera);

// Nothing when there can be no such camera.
std::optional<Camera> read_camera(ValueReader& in);

}  // namespace armsreach
