#include "tests/unit/devices/sim/ray_cast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

double meet(const Lathe& lathe, const Vector3d& o, const Vector3d& d) {
  return meet(around(lathe), o, d);
}
double meet(const Mug& mug, const Vector3d& o, const Vector3d& d) {
  return meet(around(mug), o, d);
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
double distance(const Lathe& lathe, const Vector3d& p) { return distance(around(lathe), p); }
double distance(const Mug& mug, const Vector3d& p) { return distance(around(mug), p); }

}  // namespace

std::optional<Hit> cast_ray(const World& world, const Vector3d& origin, const Vector3d& direction) {
  Hit nearest{kInfinity, -1, true};
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    const Thing& thing = world.things[i];
    const Pose thing_from_world = thing.world_from_thing.inverse();
    const Vector3d o = thing_from_world * origin;
    const Vector3d d = thing_from_world.rotation() * direction;
    const double t = std::visit([&](const auto& shape) { return meet(shape, o, d); }, thing.shape);
    if (t < nearest.distance) nearest = {t, static_cast<int>(i), !is_turned_shape(thing.shape)};
  }
  if (nearest.thing < 0) return std::nullopt;
  return nearest;
}

double clearance(const World& world, const Vector3d& point) {
  double nearest = kInfinity;
  for (const Thing& thing : world.things) {
    const Vector3d p = thing.world_from_thing.inverse() * point;
    nearest = std::min(
        nearest, std::visit([&](const auto& shape) { return distance(shape, p); }, thing.shape));
  }
  return nearest;
}

}  // namespace armsreach::sim
