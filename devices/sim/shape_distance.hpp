// How far a point is from a shape.
#pragma once

#include <Eigen/Core>

#include "devices/sim/world.hpp"

namespace armsreach::sim {

// m, negative inside the material; exact outside of boxes, cylinders, capsules, panels and solids
// of revolution (a mug's handle counts as its bent bar), at most 30 % too small beside the edges of
// tapered boxes; of a mesh, to the convex solid close around it, which fills its hollows. `point`
// is in the part's frame.
double signed_distance(const Shape& shape, const Eigen::Vector3d& point);

}  // namespace armsreach::sim
