// How the map is looked at: which way is up, what to keep in the picture, and the cameras of the
// orbiting, top, front and side views.
#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "render/scene.hpp"
#include "render/view.hpp"
#include "vision/core/world_view.hpp"

namespace armsreach::render {

// Axes of the room: x to the right and y away from where the camera first looked, z up.
using RoomFromWorld = Eigen::Quaterniond;

// Up is the scene's where it says so. Else it is guessed: people hold cameras upright, and most
// surface that faces up is level, so the mean of the normals near the camera's up is taken.
RoomFromWorld guess_room(const Scene& scene);

// The direction against gravity where it is known: the scene's, or that of mapped level surface, by
// the same guess. A camera that looks straight down does not know.
std::optional<Eigen::Vector3d> known_up(const Scene& scene);

// The extent of what is mapped, seen and inserted, in room axes; stray points are left out.
std::optional<Eigen::AlignedBox3d> scene_bounds(const Scene& scene, const RoomFromWorld& room);

// A box that follows another one calmly: it stays while the other changes little, and then moves
// within about a second of video time.
class Framing {
 public:
  void follow(const Eigen::AlignedBox3d& bounds, double time);
  const Eigen::AlignedBox3d& box() const { return box_; }  // room axes

 private:
  Eigen::AlignedBox3d box_;
  Eigen::AlignedBox3d goal_;
  double time_ = 0;
};

// The person's part of the orbiting view.
struct Orbit {
  double azimuth = 0.55;   // rad, 0 looks along the room's y
  double elevation = 0.6;  // rad above the horizon
  double zoom = 1;
  Eigen::Vector3d pan{0, 0, 0};  // m, room axes
};

View orbit_view(const Orbit& orbit, const Framing& framing, const RoomFromWorld& room, int width,
                int height);

enum class Side { top, front, side };
View side_view(Side side, const Framing& framing, const RoomFromWorld& room, int width, int height);

// The ray through a target pixel, of either kind of view.
Ray ray_through(const View& view, const Eigen::Vector2d& target_pixel);

}  // namespace armsreach::render
