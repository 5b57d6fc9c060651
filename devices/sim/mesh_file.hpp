// Meshes of things, from Wavefront .obj or .ply files.
#pragma once

#include <filesystem>

#include "devices/sim/world.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

// What is drawn on a processor costs by its corners.
inline constexpr int kMostMeshTriangles = 5000;

// Normals that the file has not are made, with creases where faces meet at more than 40 degrees; a
// picture for which it has no texture coordinates is laid over it from above (+z). `scale`: metres
// that a unit of the file is.
Result<Mesh> load_mesh(const std::filesystem::path& file, double scale);

}  // namespace armsreach::sim
