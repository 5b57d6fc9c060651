// The surface of a shape as patches: smooth pieces over the unit square. Meshes, texture
// coordinates and the places where light is gathered all come from the same patches.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/world.hpp"

namespace armsreach::sim {

struct SurfacePoint {
  Eigen::Vector3d position;  // in the thing's frame
  Eigen::Vector3d normal;    // unit, outwards
};

// u runs to the right and v upwards as seen from outside.
struct Patch {
  std::function<SurfacePoint(double u, double v)> at;
  int columns = 1;  // quadrilaterals that show its curvature
  int rows = 1;
  double width = 0;  // m, about, along u and v
  double height = 0;
  // Where a pattern measured in metres lies on it: straight along u and v, or cut out of the
  // pattern like a round piece of cloth.
  bool disc = false;
  // What a pattern that is fitted to the shape shows here: this share of it from the left and the
  // top, or, for a shape turned about z, the level z / fit_height.
  Eigen::Vector2d fit{1, 1};
  double fit_height = 0;
  // Of a mesh's triangle: it fills the half with v <= u, and the other half lies on its long side.
  const MeshTriangle* triangle = nullptr;
};

std::vector<Patch> patches_of(const Shape& shape);

// A mug without its handle as a solid of revolution, and how far a point is from the handle's bar.
std::vector<Eigen::Vector2d> mug_profile(const Mug& mug);
double distance_to_mug_handle(const Mug& mug, const Eigen::Vector3d& point);

}  // namespace armsreach::sim
