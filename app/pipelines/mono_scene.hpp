// How the sparse map and what was measured of it appear in the scene.
#pragma once

#include "render/scene.hpp"
#include "vision/core/tracked_frame.hpp"

namespace armsreach::app {

// Of a frame that has `mono`.
void add_sparse_map(const TrackedFrame& tracked, render::Scene* scene);

}  // namespace armsreach::app
