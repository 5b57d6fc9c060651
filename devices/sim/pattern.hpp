// Procedural textures: what the surfaces of a simulated world look like, painted once at the start.
#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>

#include "devices/sim/world.hpp"

namespace armsreach::sim {

// CV_8UC3 BGR with sides that are powers of two; repeats without a seam unless the material fits
// its faces.
cv::Mat paint_pattern(const Material& material, std::uint64_t seed);

}  // namespace armsreach::sim
