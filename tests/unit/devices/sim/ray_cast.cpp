#include "tests/unit/devices/sim/ray_cast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Interval {
  double enter = -kInfinity;
  double leave = kInfinity;
  void cut(double low, double high) {
    enter = std::max(enter, low);
    leave = std::min(leave, high);
  }
};

// Between two parallel planes across one axis.
void cut_slab(Interval& span, double origin, double direction, double low, double high) {
  if (direction == 0) {
    if (origin < low || origin > high) span.leave = -kInfinity;
    return;
  }
  const double a = (low - origin) / direction;
  const double b = (high - origin) / direction;
  span.cut(std::min(a, b), std::max(a, b));
}

// The origin is outside of everything, so that the first contact is where the ray enters.
double entry(const Interval& span) {
  return span.enter <= span.leave && span.enter > 0 ? span.enter : kInfinity;
}

double meet(const Box& box, const Vector3d& o, const Vector3d& d) {
  Interval span;
  cut_slab(span, o.x(), d.x(), -box.size.x() / 2, box.size.x() / 2);
  cut_slab(span, o.y(), d.y(), -box.size.y() / 2, box.size.y() / 2);
  cut_slab(span, o.z(), d.z(), 0, box.size.z());
  return entry(span);
}

double meet(const Cylinder& cylinder, const Vector3d& o, const Vector3d& d) {
  Interval span;
  cut_slab(span, o.z(), d.z(), 0, cylinder.height);
  const double a = d.head<2>().squaredNorm();
  const double b = o.head<2>().dot(d.head<2>());
  const double c = o.head<2>().squaredNorm() - cylinder.radius * cylinder.radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0 || a == 0) return kInfinity;
  span.cut((-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a);
  return entry(span);
}

double meet(const Panel& panel, const Vector3d& o, const Vector3d& d) {
  if (d.z() >= 0) return kInfinity;  // from behind
  const double t = -o.z() / d.z();
  const Vector3d p = o + t * d;
  const bool inside =
      std::abs(p.x()) <= panel.size.x() / 2 && std::abs(p.y()) <= panel.size.y() / 2;
  return inside && t > 0 ? t : kInfinity;
}

Cylinder around(const Lathe& lathe) {
  Cylinder bound;
  for (const Eigen::Vector2d& point : lathe.profile) {
    bound.radius = std::max(bound.radius, point.x());
    bound.height = std::max(bound.height, point.y());
  }
  return bound;
}
// The handle reaches out by a third of the height and a bar's thickness.
Cylinder around(const Mug& mug) { return {mug.radius + 0.45 * mug.height, mug.height}; }

// Between the planes of a convex solid: outside of one where normal . p > offset.
struct Plane {
  Vector3d normal;
  double offset;
};
double meet_convex(const std::vector<Plane>& planes, const Vector3d& o, const Vector3d& d) {
  Interval span;
  for (const Plane& plane : planes) {
    const double towards = plane.normal.dot(d);
    const double inside = plane.offset - plane.normal.dot(o);
    if (towards == 0 && inside < 0) return kInfinity;
    if (towards > 0) span.leave = std::min(span.leave, inside / towards);
    if (towards < 0) span.enter = std::max(span.enter, inside / towards);
  }
  return entry(span);
}

double meet(const TaperedBox& box, const Vector3d& o, const Vector3d& d) {
  std::vector<Plane> planes{{{0, 0, 1}, box.height}, {{0, 0, -1}, 0}};
  for (const int axis : {0, 1}) {
    for (const double side : {-1.0, 1.0}) {
      Vector3d normal = side * Vector3d::Unit(axis);
      normal.z() = (box.lower[axis] - box.upper[axis]) / 2 / box.height;
      planes.push_back({normal, box.lower[axis] / 2});
    }
  }
  return meet_convex(planes, o, d);
}

// The nearest of the trapezoids between its stations.
double meet(const Slab& slab, const Vector3d& o, const Vector3d& d) {
  double nearest = kInfinity;
  for (std::size_t i = 0; i + 1 < slab.stations.size(); ++i) {
    const Slab::Station& a = slab.stations[i];
    const Slab::Station& b = slab.stations[i + 1];
    const double low = (b.low - a.low) / (b.x - a.x);
    const double high = (b.high - a.high) / (b.x - a.x);
    nearest = std::min(nearest, meet_convex({{{0, 0, 1}, slab.thickness},
                                             {{0, 0, -1}, 0},
                                             {{-1, 0, 0}, -a.x},
                                             {{1, 0, 0}, b.x},
                                             {{low, -1, 0}, low * a.x - a.low},
                                             {{-high, 1, 0}, a.high - high * a.x}},
                                            o, d));
  }
  return nearest;
}

double meet_ball(double z, double radius, const Vector3d& o, const Vector3d& d) {
  const Vector3d from = o - Vector3d(0, 0, z);
  const double a = d.squaredNorm();
  const double b = from.dot(d);
  const double discriminant = b * b - a * (from.squaredNorm() - radius * radius);
  if (discriminant < 0) return kInfinity;
  const double t = (-b - std::sqrt(discriminant)) / a;
  return t > 0 ? t : kInfinity;
}

double meet(const Capsule& capsule, const Vector3d& o, const Vector3d& d) {
  const double r = capsule.radius;
  const Vector3d lifted = o - Vector3d(0, 0, r);
  return std::min({meet(Cylinder{r, capsule.height - 2 * r}, lifted, d), meet_ball(r, r, o, d),
                   meet_ball(capsule.height - r, r, o, d)});
}

double meet(const Lathe& lathe, const Vector3d& o, const Vector3d& d) {
  return meet(around(lathe), o, d);
}
double meet(const Mug& mug, const Vector3d& o, const Vector3d& d) {
  return meet(around(mug), o, d);
}

// The nearest of its triangles that faces the ray. Source: Moeller, Trumbore, "Fast, minimum
// storage ray-triangle intersection", 1997.
double meet(const Mesh& mesh, const Vector3d& o, const Vector3d& d) {
  double nearest = kInfinity;
  for (const MeshTriangle& triangle : *mesh.triangles) {
    const auto& [a, b, c] = triangle.positions;
    const Vector3d across = d.cross(c - a);
    const double determinant = (b - a).dot(across);
    if (determinant <= 0) continue;
    const double u = (o - a).dot(across) / determinant;
    const Vector3d along = (o - a).cross(b - a);
    const double v = d.dot(along) / determinant;
    const double t = (c - a).dot(along) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0) nearest = std::min(nearest, t);
  }
  return nearest;
}

bool is_turned_shape(const Shape& shape) {
  return std::holds_alternative<Lathe>(shape) || std::holds_alternative<Mug>(shape);
}

double distance_to_box(const Vector3d& half_size, double height, const Vector3d& p) {
  const Vector3d above_below(std::abs(p.x()) - half_size.x(), std::abs(p.y()) - half_size.y(),
                             std::max(-p.z(), p.z() - height));
  return above_below.cwiseMax(0).norm();
}
double distance(const Box& box, const Vector3d& p) {
  return distance_to_box(box.size / 2, box.size.z(), p);
}
double distance(const Panel& panel, const Vector3d& p) {
  return distance_to_box({panel.size.x() / 2, panel.size.y() / 2, 0}, 0, p);
}
double distance(const Cylinder& cylinder, const Vector3d& p) {
  const double outside = std::max(0.0, p.head<2>().norm() - cylinder.radius);
  const double beyond = std::max({0.0, -p.z(), p.z() - cylinder.height});
  return std::hypot(outside, beyond);
}
double distance(const Capsule& capsule, const Vector3d& p) {
  return distance(Cylinder{capsule.radius, capsule.height}, p);
}
double distance(const TaperedBox& box, const Vector3d& p) {
  const Eigen::Vector2d half = box.lower.cwiseMax(box.upper) / 2;
  return distance_to_box({half.x(), half.y(), 0}, box.height, p);
}
double distance(const Slab& slab, const Vector3d& p) {
  double half = 0;
  for (const Slab::Station& one : slab.stations)
    half = std::max({half, std::abs(one.low), std::abs(one.high)});
  const double from = slab.stations.front().x;
  const double to = slab.stations.back().x;
  const Vector3d centred = p - Vector3d((from + to) / 2, 0, 0);
  return distance_to_box({(to - from) / 2, half, 0}, slab.thickness, centred);
}
double distance(const Mesh& mesh, const Vector3d& p) {
  Eigen::AlignedBox3d box;
  for (const MeshTriangle& triangle : *mesh.triangles) {
    for (const Vector3d& corner : triangle.positions) box.extend(corner);
  }
  return box.exteriorDistance(p);
}
double distance(const Lathe& lathe, const Vector3d& p) { return distance(around(lathe), p); }
double distance(const Mug& mug, const Vector3d& p) { return distance(around(mug), p); }

}  // namespace

std::optional<Hit> cast_ray(const World& world, const std::vector<Pose>& world_from_thing,
                            const Vector3d& origin, const Vector3d& direction) {
  Hit nearest{kInfinity, -1, -1, true};
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    const Part& part = world.parts[i];
    const Pose part_from_world =
        (world_from_thing[static_cast<std::size_t>(part.thing)] * part.thing_from_part).inverse();
    const Vector3d o = part_from_world * origin;
    const Vector3d d = part_from_world.rotation() * direction;
    const double t = std::visit([&](const auto& shape) { return meet(shape, o, d); }, part.shape);
    if (t < nearest.distance)
      nearest = {t, part.thing, static_cast<int>(i), !is_turned_shape(part.shape)};
  }
  if (nearest.thing < 0) return std::nullopt;
  return nearest;
}

double clearance(const World& world, const std::vector<Pose>& world_from_thing,
                 const Vector3d& point) {
  double nearest = kInfinity;
  for (const Part& part : world.parts) {
    const Pose world_from_part =
        world_from_thing[static_cast<std::size_t>(part.thing)] * part.thing_from_part;
    const Vector3d p = world_from_part.inverse() * point;
    nearest = std::min(
        nearest, std::visit([&](const auto& shape) { return distance(shape, p); }, part.shape));
  }
  return nearest;
}

}  // namespace armsreach::sim
