// Light on all surfaces of a world, gathered once: the key light with soft shadows and what comes
// from all sides, darker where things stand close together. Things that move are gathered each by
// itself: how open to a white room its surface is.
#pragma once

#include <opencv2/core/mat.hpp>

#include "devices/sim/gpu_world.hpp"
#include "devices/sim/world.hpp"
#include "devices/sim/world_mesh.hpp"
#include "render/gl_objects.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

// The light map stores square roots of light, as 255ths of this.
constexpr float kLightRange = 1.5F;

// CV_8UC4 BGR of the atlas's size, and in alpha the share of light that is the key light's.
Result<cv::Mat> gather_light(const render::Gl& gl, const World& world, const WorldMesh& mesh,
                             const GpuWorld& gpu_world);

}  // namespace armsreach::sim
