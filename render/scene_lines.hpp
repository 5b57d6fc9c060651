// The scene's things that are drawn as lines.
#pragma once

#include <Eigen/Geometry>

#include "render/line_painter.hpp"
#include "render/room.hpp"
#include "render/scene.hpp"

namespace armsreach::render {

// A square grid on the lowest level of a box in room axes, fading outwards.
void add_ground(Lines& lines, const Eigen::AlignedBox3d& box, const RoomFromWorld& room);

// The camera as a pyramid `size` metres long with its image's outline, as the lens sees it.
void add_camera(Lines& lines, const Scene& scene, double size);

// Trails, fading with age.
void add_trails(Lines& lines, const Scene& scene);

// 1, 2 or 5 times a power of ten, at most `limit`.
double round_length(double limit);

}  // namespace armsreach::render
