#include "devices/sim/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "devices/sim/patches.hpp"
#include "devices/sim/shape_distance.hpp"

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing = 0.005;  // m, of the points
// Parts larger than this have none: what touches them is smaller and touches with its own.
constexpr double kLarge = 0.6;  // m

int points_along(double length, int at_least) {
  return std::max(at_least, static_cast<int>(std::ceil(length / kSpacing)));
}

// Of a box in another frame.
Eigen::AlignedBox3d box_around(const Pose& to_from_from, const Eigen::AlignedBox3d& from) {
  Eigen::AlignedBox3d to;
  for (int corner = 0; corner < 8; ++corner) {
    const auto type = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
    to.extend(to_from_from * Vector3d(from.corner(type)));
  }
  return to;
}

bool equal(const Pose& a, const Pose& b) {
  return a.translation() == b.translation() && a.rotation().coeffs() == b.rotation().coeffs();
}

}  // namespace

ContactFinder::ContactFinder(const World& world) : world_(world), bodies_(world.things.size()) {
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    const Part& part = world.parts[i];
    Body& body = bodies_[static_cast<std::size_t>(part.thing)];
    body.parts.push_back(static_cast<int>(i));
    for (const Patch& patch : patches_of(part.shape)) {
      const bool large = std::max(patch.width, patch.height) > kLarge;
      const int columns = large ? 1 : points_along(patch.width, patch.columns);
      const int rows = large ? 1 : points_along(patch.height, patch.rows);
      for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
          const double u = static_cast<double>(column) / columns;
          const double v = static_cast<double>(row) / rows;
          const Vector3d point = part.thing_from_part * patch.at(u, v).position;
          body.box.extend(point);
          if (!large) body.points.push_back(point);
        }
      }
    }
  }
}

// Whether any point of one thing touches the other.
bool ContactFinder::reaches(const Body& points_of, int other, const Pose& other_from_body) const {
  const Body& target = bodies_[static_cast<std::size_t>(other)];
  Eigen::AlignedBox3d near = target.box;
  near.min().array() -= kTouching;
  near.max().array() += kTouching;
  if (!near.intersects(box_around(other_from_body, points_of.box))) return false;
  for (const Vector3d& point : points_of.points) {
    const Vector3d place = other_from_body * point;
    if (!near.contains(place)) continue;
    for (const int part : target.parts) {
      const Part& one = world_.parts[static_cast<std::size_t>(part)];
      if (signed_distance(one.shape, one.thing_from_part.inverse() * place) <= kTouching)
        return true;
    }
  }
  return false;
}

bool ContactFinder::touch(int a, int b, const Pose& b_from_a) const {
  const Body& body_a = bodies_[static_cast<std::size_t>(a)];
  const Body& body_b = bodies_[static_cast<std::size_t>(b)];
  const double apart = (b_from_a * Vector3d(body_a.box.center()) - body_b.box.center()).norm();
  const double reach = 0.5 * (body_a.box.diagonal().norm() + body_b.box.diagonal().norm());
  if (apart > reach + kTouching) return false;
  return reaches(body_a, b, b_from_a) || reaches(body_b, a, b_from_a.inverse());
}

std::vector<std::pair<int, int>> ContactFinder::at(const std::vector<Pose>& world_from_thing) {
  std::vector<std::pair<int, int>> touching;
  const int count = static_cast<int>(world_.things.size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      const auto thing = [this](int i) -> const Thing& {
        return world_.things[static_cast<std::size_t>(i)];
      };
      if (!thing(a).moves && !thing(b).moves) continue;
      const Pose b_from_a = world_from_thing[static_cast<std::size_t>(b)].inverse() *
                            world_from_thing[static_cast<std::size_t>(a)];
      auto [found, is_new] = known_.try_emplace({a, b});
      Pair& pair = found->second;
      if (is_new || !equal(pair.b_from_a, b_from_a)) pair = {b_from_a, touch(a, b, b_from_a)};
      if (pair.touching) touching.emplace_back(a, b);
    }
  }
  return touching;
}

}  // namespace armsreach::sim
