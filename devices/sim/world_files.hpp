// The files that a world names: meshes and pictures.
#pragma once

#include <filesystem>

#include "devices/sim/world.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

// Their names are relative to `folder`, where the world's own file lies.
Status load_files(const std::filesystem::path& folder, World& world);

}  // namespace armsreach::sim
