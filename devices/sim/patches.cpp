#include "devices/sim/patches.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace armsreach::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTurn = 2 * std::numbers::pi;
// A circle of radius r is drawn as a polygon that lies up to r (1 - cos(pi / n)) inside it: 21 um
// for a mug's 4 cm.
constexpr int kSegments = 96;
constexpr double kSmoothCosine = 0.766;  // profile corners under 40 degrees are rounded

Patch flat(const Vector3d& centre, const Vector3d& along_u, const Vector3d& along_v) {
  const Vector3d normal = along_u.cross(along_v).normalized();
  Patch patch;
  patch.at = [=](double u, double v) {
    return SurfacePoint{centre + (u - 0.5) * along_u + (v - 0.5) * along_v, normal};
  };
  patch.width = along_u.norm();
  patch.height = along_v.norm();
  return patch;
}

std::vector<Patch> patches(const Box& box) {
  const Vector3d x = box.size.x() * Vector3d::UnitX();
  const Vector3d y = box.size.y() * Vector3d::UnitY();
  const Vector3d z = box.size.z() * Vector3d::UnitZ();
  const Vector3d centre = z / 2;
  std::vector<Patch> made{flat(centre + z / 2, x, y),  flat(centre - y / 2, x, z),
                          flat(centre + x / 2, y, z),  flat(centre + y / 2, -x, z),
                          flat(centre - x / 2, -y, z), flat(centre - z / 2, x, -y)};
  // The largest face shows a fitted pattern whole, the others as much as fits at the same scale.
  const auto area = [](const Patch& p) { return p.width * p.height; };
  const auto largest = std::max_element(
      made.begin(), made.end(), [&](const Patch& a, const Patch& b) { return area(a) < area(b); });
  const Vector2d whole(largest->width, largest->height);
  for (Patch& patch : made)
    patch.fit = Vector2d(patch.width, patch.height).cwiseQuotient(whole).cwiseMin(1);
  return made;
}

std::vector<Patch> patches(const Panel& panel) {
  return {flat(Vector3d::Zero(), panel.size.x() * Vector3d::UnitX(),
               panel.size.y() * Vector3d::UnitY())};
}

Vector3d around(double u, double radius, double z) {
  return {radius * std::cos(kTurn * u), radius * std::sin(kTurn * u), z};
}

// One straight piece of a profile turned about z; the normals at its ends are (radial, z).
Patch turned(const Vector2d& from, const Vector2d& to, const Vector2d& normal_from,
             const Vector2d& normal_to) {
  Patch patch;
  patch.at = [=](double u, double v) {
    const Vector2d p = (1 - v) * from + v * to;
    const Vector2d n = ((1 - v) * normal_from + v * normal_to).normalized();
    return SurfacePoint{around(u, p.x(), p.y()), around(u, n.x(), n.y())};
  };
  patch.columns = kSegments;
  patch.width = kTurn * std::max(from.x(), to.x());
  patch.height = (to - from).norm();
  patch.disc = std::abs(to.y() - from.y()) < 0.3 * patch.height;
  return patch;
}

std::vector<Patch> patches(const Lathe& lathe) {
  const auto& profile = lathe.profile;
  std::vector<Vector2d> normals;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Vector2d along = (profile[i] - profile[i - 1]).normalized();
    normals.emplace_back(along.y(), -along.x());
  }
  const auto joint = [&](std::size_t own, std::size_t other) -> Vector2d {
    if (other >= normals.size() || normals[own].dot(normals[other]) < kSmoothCosine)
      return normals[own];
    return (normals[own] + normals[other]).normalized();
  };
  std::vector<Patch> made;
  for (std::size_t i = 0; i < normals.size(); ++i)
    made.push_back(turned(profile[i], profile[i + 1], joint(i, i - 1), joint(i, i + 1)));
  double height = 0;
  for (const Vector2d& point : profile) height = std::max(height, point.y());
  for (Patch& patch : made) patch.fit_height = height;
  return made;
}

std::vector<Patch> patches(const Cylinder& cylinder) {
  const double r = cylinder.radius;
  const double h = cylinder.height;
  return patches(Lathe{{{0, 0}, {r, 0}, {r, h}, {0, h}}});
}

// A bent round bar from low on the mug's side to high on it, in the plane y = 0.
Patch handle(const Mug& mug) {
  const double bar = 0.07 * mug.height;
  const double reach = 0.32 * mug.height;
  const double half = 0.31 * mug.height;
  const Vector2d centre(mug.radius - 0.5 * mug.wall, 0.52 * mug.height);
  Patch patch;
  patch.at = [=](double u, double v) {
    const double angle = std::numbers::pi * (v - 0.5);  // along the bend, upwards
    const Vector2d outwards =
        Vector2d(half * std::cos(angle), reach * std::sin(angle)).normalized();
    const Vector2d middle = centre + Vector2d(reach * std::cos(angle), half * std::sin(angle));
    const double c = std::cos(kTurn * u);
    const double s = std::sin(kTurn * u);
    const Vector3d normal(c * outwards.x(), s, c * outwards.y());
    return SurfacePoint{Vector3d(middle.x(), 0, middle.y()) + bar * normal, normal};
  };
  patch.columns = 16;
  patch.rows = 24;
  patch.width = kTurn * bar;
  patch.height = std::numbers::pi * reach;
  patch.fit_height = mug.height;
  return patch;
}

std::vector<Patch> patches(const Mug& mug) {
  const double r = mug.radius;
  const double inside = r - mug.wall;
  const double h = mug.height;
  const double foot = 0.06 * h;
  const double rim = mug.wall / 2;
  const Lathe body{{{0, 0},
                    {0.82 * r, 0},
                    {0.93 * r, 0.35 * foot},
                    {r, foot},
                    {r, h - rim},
                    {r - 0.5 * rim, h - 0.15 * rim},
                    {r - rim, h},
                    {inside + 0.5 * rim, h - 0.15 * rim},
                    {inside, h - rim},
                    {inside, foot + mug.wall},
                    {0.9 * inside, foot},
                    {0, foot}}};
  std::vector<Patch> made = patches(body);
  made.push_back(handle(mug));
  return made;
}

}  // namespace

std::vector<Patch> patches_of(const Shape& shape) {
  return std::visit([](const auto& one) { return patches(one); }, shape);
}

}  // namespace armsreach::sim
