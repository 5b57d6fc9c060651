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

// The sparse map's points with their ellipsoids of three deviations, or, where that would be too
// much, as crosses; and what is guessed of those not yet known.
enum class PointDetail { crosses, ellipsoids };
void add_points(Lines& lines, const Scene& scene, PointDetail detail);

// x red, y green, z blue, `size` metres long.
void add_world_axes(Lines& lines, double size);

theme::Color color_of(FeatureState state);

// 1, 2 or 5 times a power of ten, at most `limit`.
double round_length(double limit);

}  // namespace armsreach::render
