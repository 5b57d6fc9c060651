#include "devices/sim/patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

namespace armsreach::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTurn = 2 * std::numbers::pi;
// A circle of radius r is drawn as a polygon that lies up to r (1 - cos(pi / n)) inside it.
constexpr double kRoundness = 100e-6;  // m, a twentieth of what a pixel of 320 sees at 0.5 m

int segments_of(double radius) {
  const double half_corner = std::acos(1 - std::min(kRoundness / radius, 0.5));
  return std::clamp(static_cast<int>(std::ceil(std::numbers::pi / half_corner)), 12, 128);
}

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
             const Vector2d& normal_to, int segments) {
  Patch patch;
  patch.at = [=](double u, double v) {
    const Vector2d p = (1 - v) * from + v * to;
    const Vector2d n = ((1 - v) * normal_from + v * normal_to).normalized();
    return SurfacePoint{around(u, p.x(), p.y()), around(u, n.x(), n.y())};
  };
  patch.columns = segments;
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
  double widest = 0;
  for (const Vector2d& point : profile) widest = std::max(widest, point.x());
  const int segments = segments_of(widest);
  std::vector<Patch> made;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    made.push_back(turned(profile[i], profile[i + 1], joint(i, i - 1), joint(i, i + 1), segments));
  }
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

std::vector<Patch> patches(const Capsule& capsule) {
  const double r = capsule.radius;
  const int steps = segments_of(r) / 4;  // of a quarter turn: corners of 30 degrees are rounded
  Lathe lathe{{{0, 0}}};
  for (int i = 1; i <= steps; ++i) {
    const double angle = kTurn / 4 * i / steps;
    lathe.profile.emplace_back(r * std::sin(angle), r - r * std::cos(angle));
  }
  for (int i = steps; i >= 0; --i) {  // the same from the other end
    const Vector2d lower = lathe.profile[static_cast<std::size_t>(i)];
    lathe.profile.emplace_back(lower.x(), capsule.height - lower.y());
  }
  return patches(lathe);
}

// A flat piece between four corners, counter-clockwise as seen from outside from the lower left.
Patch quadrilateral(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d normal = (c - a).cross(d - b).normalized();
  Patch patch;
  patch.at = [=](double u, double v) {
    return SurfacePoint{(1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * d + u * c), normal};
  };
  patch.width = std::max((b - a).norm(), (c - d).norm());
  patch.height = std::max((d - a).norm(), (c - b).norm());
  return patch;
}

std::vector<Patch> patches(const TaperedBox& box) {
  const auto corner = [&](int x, int y, int z) {
    const Vector2d half = (z == 0 ? box.lower : box.upper) / 2;
    return Vector3d(x * half.x(), y * half.y(), z * box.height);
  };
  const auto side = [&](int ax, int ay, int bx, int by) {
    return quadrilateral(corner(ax, ay, 0), corner(bx, by, 0), corner(bx, by, 1),
                         corner(ax, ay, 1));
  };
  return {quadrilateral(corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1), corner(-1, 1, 1)),
          quadrilateral(corner(-1, 1, 0), corner(1, 1, 0), corner(1, -1, 0), corner(-1, -1, 0)),
          side(-1, -1, 1, -1),
          side(1, -1, 1, 1),
          side(1, 1, -1, 1),
          side(-1, 1, -1, -1)};
}

// The cap at `z`: u runs through the stations, straight between each two of them.
Patch cap(const Slab& slab, double z, bool upper) {
  const auto& stations = slab.stations;
  double height = 0;
  for (const Slab::Station& one : stations) height = std::max(height, one.high - one.low);
  Patch patch;
  patch.columns = static_cast<int>(stations.size()) - 1;
  patch.width = stations.back().x - stations.front().x;
  patch.height = height;
  patch.at = [=](double u, double v) {
    const double along = (upper ? u : 1 - u) * (static_cast<double>(stations.size()) - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(along), stations.size() - 2);
    const double share = along - static_cast<double>(i);
    const Slab::Station& a = stations[i];
    const Slab::Station& b = stations[i + 1];
    const double low = a.low + share * (b.low - a.low);
    const double high = a.high + share * (b.high - a.high);
    return SurfacePoint{{a.x + share * (b.x - a.x), low + v * (high - low), z},
                        {0, 0, upper ? 1.0 : -1.0}};
  };
  return patch;
}

std::vector<Patch> patches(const Slab& slab) {
  const auto& stations = slab.stations;
  std::vector<Patch> made{cap(slab, slab.thickness, true), cap(slab, 0, false)};
  const auto wall = [&](const Vector2d& from, const Vector2d& to) {
    if ((to - from).norm() < 1e-9) return;
    const Vector3d a(from.x(), from.y(), 0);
    const Vector3d b(to.x(), to.y(), 0);
    const Vector3d up = slab.thickness * Vector3d::UnitZ();
    made.push_back(quadrilateral(a, b, b + up, a + up));
  };
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    wall({stations[i].x, stations[i].low}, {stations[i + 1].x, stations[i + 1].low});
    wall({stations[i + 1].x, stations[i + 1].high}, {stations[i].x, stations[i].high});
  }
  wall({stations.back().x, stations.back().low}, {stations.back().x, stations.back().high});
  wall({stations.front().x, stations.front().high}, {stations.front().x, stations.front().low});
  return made;
}

// A bent round bar from low on the mug's side to high on it, in the plane y = 0.
struct Handle {
  explicit Handle(const Mug& mug)
      : bar(0.07 * mug.height),
        reach(0.32 * mug.height),
        half(0.31 * mug.height),
        centre(mug.radius - 0.5 * mug.wall, 0.52 * mug.height) {}

  // `angle`: along the bend, upwards from -90 to 90 degrees; (x, z).
  Vector2d middle(double angle) const {
    return centre + Vector2d(reach * std::cos(angle), half * std::sin(angle));
  }
  Vector2d outwards(double angle) const {
    return Vector2d(half * std::cos(angle), reach * std::sin(angle)).normalized();
  }

  double bar;  // radius of the bar
  double reach;
  double half;  // of its height
  Vector2d centre;
};

Patch handle(const Mug& mug) {
  const Handle handle(mug);
  Patch patch;
  patch.at = [handle](double u, double v) {
    const double angle = std::numbers::pi * (v - 0.5);
    const Vector2d outwards = handle.outwards(angle);
    const Vector2d middle = handle.middle(angle);
    const double c = std::cos(kTurn * u);
    const double s = std::sin(kTurn * u);
    const Vector3d normal(c * outwards.x(), s, c * outwards.y());
    return SurfacePoint{Vector3d(middle.x(), 0, middle.y()) + handle.bar * normal, normal};
  };
  patch.columns = segments_of(handle.bar);
  patch.rows = segments_of(handle.reach) / 2;
  patch.width = kTurn * handle.bar;
  patch.height = std::numbers::pi * handle.reach;
  patch.fit_height = mug.height;
  return patch;
}

std::vector<Patch> patches(const Mug& mug) {
  std::vector<Patch> made = patches(Lathe{mug_profile(mug)});
  made.push_back(handle(mug));
  return made;
}

// On the unit square's half below the diagonal; what is above it falls onto the diagonal.
Patch patch_of(const std::shared_ptr<const std::vector<MeshTriangle>>& mesh,
               const MeshTriangle& triangle) {
  Patch patch;
  patch.at = [mesh, &triangle](double u, double v) {
    if (v > u) u = v = (u + v) / 2;
    const Vector3d shares(1 - u, u - v, v);
    SurfacePoint point{Vector3d::Zero(), Vector3d::Zero()};
    for (std::size_t i = 0; i < 3; ++i) {
      point.position += shares[static_cast<Eigen::Index>(i)] * triangle.positions[i];
      point.normal += shares[static_cast<Eigen::Index>(i)] * triangle.normals[i];
    }
    point.normal.normalize();
    return point;
  };
  patch.width = (triangle.positions[1] - triangle.positions[0]).norm();
  patch.height = (triangle.positions[2] - triangle.positions[1]).norm();
  patch.triangle = &triangle;
  return patch;
}

std::vector<Patch> patches(const Mesh& mesh) {
  std::vector<Patch> made;
  if (!mesh.triangles) return made;
  for (const MeshTriangle& triangle : *mesh.triangles)
    made.push_back(patch_of(mesh.triangles, triangle));
  return made;
}

}  // namespace

std::vector<Vector2d> mug_profile(const Mug& mug) {
  const double r = mug.radius;
  const double inside = r - mug.wall;
  const double h = mug.height;
  const double foot = 0.06 * h;
  const double rim = mug.wall / 2;
  return {{0, 0},
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
          {0, foot}};
}

double distance_to_mug_handle(const Mug& mug, const Vector3d& point) {
  constexpr int kSteps = 24;
  const Handle handle(mug);
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    const Vector2d middle =
        handle.middle(std::numbers::pi * (static_cast<double>(i) / kSteps - 0.5));
    nearest = std::min(nearest, (point - Vector3d(middle.x(), 0, middle.y())).norm());
  }
  return nearest - handle.bar;
}

std::vector<Patch> patches_of(const Shape& shape) {
  return std::visit([](const auto& one) { return patches(one); }, shape);
}

}  // namespace armsreach::sim
