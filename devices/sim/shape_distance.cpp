#include "devices/sim/shape_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "devices/sim/patches.hpp"

namespace armsreach::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Of a region that is the product of two: what both distances say together.
double both(double a, double b) {
  return std::hypot(std::max(a, 0.0), std::max(b, 0.0)) + std::min(std::max(a, b), 0.0);
}

double between(double value, double low, double high) {
  return std::max(low - value, value - high);
}

double distance(const Box& box, const Vector3d& p) {
  const Vector3d beyond(std::abs(p.x()) - box.size.x() / 2, std::abs(p.y()) - box.size.y() / 2,
                        between(p.z(), 0, box.size.z()));
  return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

double distance(const Panel& panel, const Vector3d& p) {
  return distance(Box{{panel.size.x(), panel.size.y(), 0}}, p);
}

double distance(const Cylinder& cylinder, const Vector3d& p) {
  return both(p.head<2>().norm() - cylinder.radius, between(p.z(), 0, cylinder.height));
}

double distance(const Capsule& capsule, const Vector3d& p) {
  const double z = std::clamp(p.z(), capsule.radius, capsule.height - capsule.radius);
  return (p - Vector3d(0, 0, z)).norm() - capsule.radius;
}

double distance_to_segment(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const Vector2d along = b - a;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0;
  return (p - a - share * along).norm();
}

// Whether a ray from `p` towards +x crosses the segment.
bool crosses(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  return p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

// To a polygon whose last side, back to its first corner, is given by the corners too.
double distance_to_polygon(const std::vector<Vector2d>& corners, const Vector2d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    nearest = std::min(nearest, distance_to_segment(corners[i], corners[i + 1], p));
    inside ^= crosses(corners[i], corners[i + 1], p);
  }
  return inside ? -nearest : nearest;
}

// The profile's ends lie on the axis, which is no surface but which no ray outwards crosses.
double distance(const Lathe& lathe, const Vector3d& p) {
  return distance_to_polygon(lathe.profile, {p.head<2>().norm(), p.z()});
}

double distance(const Mug& mug, const Vector3d& p) {
  const double body = distance_to_polygon(mug_profile(mug), {p.head<2>().norm(), p.z()});
  return std::min(body, distance_to_mug_handle(mug, p));
}

// The farthest of six planes; what lies beyond two of them is a little farther than that.
double distance(const TaperedBox& box, const Vector3d& p) {
  double most = between(p.z(), 0, box.height);
  for (int axis = 0; axis < 2; ++axis) {
    const double inset = (box.lower[axis] - box.upper[axis]) / 2;
    const double slope = inset / box.height;
    const double beyond = std::abs(p[axis]) - box.lower[axis] / 2 + slope * p.z();
    most = std::max(most, beyond / std::hypot(1, slope));
  }
  return most;
}

double distance(const Slab& slab, const Vector3d& p) {
  std::vector<Vector2d> outline;
  for (const Slab::Station& one : slab.stations) outline.emplace_back(one.x, one.low);
  for (auto one = slab.stations.rbegin(); one != slab.stations.rend(); ++one)
    outline.emplace_back(one->x, one->high);
  outline.push_back(outline.front());
  return both(distance_to_polygon(outline, p.head<2>()), between(p.z(), 0, slab.thickness));
}

double distance(const Mesh& mesh, const Vector3d& p) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Eigen::Hyperplane<double, 3>& side : mesh.around)
    most = std::max(most, side.signedDistance(p));
  return most;
}

}  // namespace

double signed_distance(const Shape& shape, const Vector3d& point) {
  return std::visit([&](const auto& one) { return distance(one, point); }, shape);
}

}  // namespace armsreach::sim
