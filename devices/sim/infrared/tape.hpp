// Pieces of retro-reflective tape: what a camera with a light around its lens sees as markers.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "vision/core/pose.hpp"

namespace armsreach::sim {

struct TapeFacet {
  std::vector<Eigen::Vector3d> outline;  // convex, flat
  Eigen::Vector3d normal;                // unit, outwards
};

// All of it in one frame.
struct TapePiece {
  std::string name;
  std::vector<TapeFacet> facets;
  // Of a square, counter-clockwise seen from outside: right front, left front, left back, right
  // back of its own x (right) and y (front). Of a disc: none.
  std::vector<Eigen::Vector3d> corners;
  Eigen::Vector3d centre{0, 0, 0};
  Eigen::Vector3d normal{0, 0, 1};  // at the centre

  void move(const Pose& to_from_here);
};

// Flat pieces around the origin of their own frame, in z = 0, seen from +z.
TapePiece tape_disc(const std::string& name, double diameter);
// `inner`: a square hole in it, `inner_centre` from the middle; cut along a grid of square cells,
// so that size, hole and the hole's distance from the edges are whole multiples of `cell`.
TapePiece tape_square(const std::string& name, double side);
TapePiece tape_frame(const std::string& name, double cell, int cells, int inner_cells,
                     const Eigen::Vector2i& inner_at);

// A square bent around a cylinder of `radius` about the y axis, `angle` from -z towards +x.
TapePiece tape_on_cylinder(const std::string& name, double side, double radius, double angle);

}  // namespace armsreach::sim
