#include "devices/sim/infrared/tape.hpp"

#include <cmath>
#include <numbers>

namespace armsreach::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d flat(double x, double y) { return {x, y, 0}; }

std::vector<Vector3d> rectangle(const Vector2d& low, const Vector2d& high) {
  return {flat(high.x(), high.y()), flat(low.x(), high.y()), flat(low.x(), low.y()),
          flat(high.x(), low.y())};
}

}  // namespace

void TapePiece::move(const Pose& to_from_here) {
  for (TapeFacet& facet : facets) {
    for (Vector3d& corner : facet.outline) corner = to_from_here * corner;
    facet.normal = to_from_here.rotation() * facet.normal;
  }
  for (Vector3d& corner : corners) corner = to_from_here * corner;
  centre = to_from_here * centre;
  normal = to_from_here.rotation() * normal;
}

TapePiece tape_disc(const std::string& name, double diameter) {
  constexpr int kCorners = 24;
  TapePiece piece;
  piece.name = name;
  TapeFacet facet;
  facet.normal = Vector3d::UnitZ();
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    facet.outline.push_back(0.5 * diameter * flat(std::cos(angle), std::sin(angle)));
  }
  piece.facets.push_back(facet);
  return piece;
}

TapePiece tape_square(const std::string& name, double side) {
  return tape_frame(name, side, 1, 0, {0, 0});
}

TapePiece tape_frame(const std::string& name, double cell, int cells, int inner_cells,
                     const Eigen::Vector2i& inner_at) {
  TapePiece piece;
  piece.name = name;
  const Vector2d low = Vector2d::Constant(-0.5 * cells * cell);
  piece.corners = rectangle(low, -low);
  // Small cells also follow a lens's bent lines.
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const Eigen::Vector2i inside = Eigen::Vector2i(x, y) - inner_at;
      if (inside.minCoeff() >= 0 && inside.maxCoeff() < inner_cells) continue;
      const Vector2d corner = low + cell * Vector2d(x, y);
      piece.facets.push_back(
          {rectangle(corner, corner + Vector2d::Constant(cell)), Vector3d::UnitZ()});
    }
  }
  return piece;
}

TapePiece tape_on_cylinder(const std::string& name, double side, double radius, double angle) {
  constexpr int kStrips = 6;
  const double half = 0.5 * side;
  const auto outwards = [](double a) { return Vector3d(std::sin(a), 0, -std::cos(a)); };
  const auto at = [&](double a, double y) -> Vector3d {
    return radius * outwards(a) + y * Vector3d::UnitY();
  };
  const auto patch = [&](double from, double to) -> std::vector<Vector3d> {
    return {at(from, half), at(to, half), at(to, -half), at(from, -half)};
  };
  TapePiece piece;
  piece.name = name;
  const double width = side / radius;
  const double first = angle - 0.5 * width;
  for (int i = 0; i < kStrips; ++i) {
    const double from = first + width * i / kStrips;
    const double to = first + width * (i + 1) / kStrips;
    piece.facets.push_back({patch(from, to), outwards(0.5 * (from + to))});
  }
  piece.corners = patch(first, first + width);
  piece.centre = at(angle, 0);
  piece.normal = outwards(angle);
  return piece;
}

}  // namespace armsreach::sim
