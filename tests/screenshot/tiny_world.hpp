// A table with a block on it in front of a wall, seen by any camera: pictures, exact depth and
// surface by ray casting, small enough to be made anew in every test.
#pragma once

#include "render/scene.hpp"

namespace armsreach::render::test {

// World: z up, the table's top is z = 0 and 1.2 x 0.8 m about the origin; the block stands at
// (-0.12, -0.12); the wall is y = 0.7.
inline const Eigen::Vector3d kBlockLow{-0.17, -0.17, 0};
inline const Eigen::Vector3d kBlockHigh{-0.07, -0.09, 0.11};

// At a person's eye, 0.9 m from the table's middle.
Pose world_from_viewer();

// Background and depth by ray casting; the pose is known, nothing is inserted.
Scene tiny_scene(const Camera& camera, const Pose& world_from_camera);

// The surface as elements of `size` metres in blocks of 8 x 8 x 8.
SurfacePtr tiny_surface(float size);

// A mesh standing on the table.
VirtualObject standing(std::int64_t id, const std::string& mesh, double x, double y);

}  // namespace armsreach::render::test
