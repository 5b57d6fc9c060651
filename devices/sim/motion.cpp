#include "devices/sim/motion.hpp"

#include <algorithm>
#include <utility>

namespace armsreach::sim {
namespace {

// Per second, of position and (in the thing's own frame) orientation.
struct Velocity {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
};

Velocity between(const ThingKey& a, const ThingKey& b) {
  const double seconds = b.time - a.time;
  const Pose& from = a.world_from_thing;
  const Pose& to = b.world_from_thing;
  return {(to.translation() - from.translation()) / seconds,
          so3_log(from.rotation().conjugate() * to.rotation()) / seconds};
}

bool equal(const Pose& a, const Pose& b) {
  return a.translation() == b.translation() && a.rotation().coeffs() == b.rotation().coeffs();
}

// Velocity of the curve at a key: none at the ends and beside a rest, else the mean of both sides,
// each weighted by how short it is (a parabola through the three keys).
Velocity velocity_at(const std::vector<ThingKey>& keys, std::size_t i) {
  if (i == 0 || i + 1 == keys.size()) return {};
  if (equal(keys[i].world_from_thing, keys[i - 1].world_from_thing) ||
      equal(keys[i].world_from_thing, keys[i + 1].world_from_thing))
    return {};
  const Velocity before = between(keys[i - 1], keys[i]);
  const Velocity after = between(keys[i], keys[i + 1]);
  const double share = (keys[i].time - keys[i - 1].time) / (keys[i + 1].time - keys[i - 1].time);
  return {(1 - share) * before.linear + share * after.linear,
          (1 - share) * before.angular + share * after.angular};
}

// A cubic through two poses with given velocities, as Bezier curves of position and orientation.
// Source: Shoemake, "Animating rotation with quaternion curves", SIGGRAPH 1985.
Pose cubic(const ThingKey& a, const Velocity& va, const ThingKey& b, const Velocity& vb, double s) {
  const double third = (b.time - a.time) / 3;
  const Eigen::Vector3d p0 = a.world_from_thing.translation();
  const Eigen::Vector3d p3 = b.world_from_thing.translation();
  const Eigen::Vector3d p1 = p0 + third * va.linear;
  const Eigen::Vector3d p2 = p3 - third * vb.linear;
  const double r = 1 - s;
  const Eigen::Vector3d position =
      r * r * r * p0 + 3 * r * r * s * p1 + 3 * r * s * s * p2 + s * s * s * p3;
  const Eigen::Quaterniond q0 = a.world_from_thing.rotation();
  const Eigen::Quaterniond q3 = b.world_from_thing.rotation();
  const Eigen::Quaterniond q1 = q0 * so3_exp(third * va.angular);
  const Eigen::Quaterniond q2 = q3 * so3_exp(-third * vb.angular);
  const Eigen::Quaterniond middle = q1.slerp(s, q2);
  const Eigen::Quaterniond left = q0.slerp(s, q1).slerp(s, middle);
  const Eigen::Quaterniond right = middle.slerp(s, q2.slerp(s, q3));
  return {left.slerp(s, right), position};
}

}  // namespace

Pose pose_at(const Thing& thing, double time) {
  const std::vector<ThingKey>& keys = thing.keys;
  if (keys.empty()) return thing.world_from_thing;
  if (time <= keys.front().time) return keys.front().world_from_thing;
  if (time >= keys.back().time) return keys.back().world_from_thing;
  const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                      [](double t, const ThingKey& key) { return t < key.time; });
  const std::size_t i = static_cast<std::size_t>(after - keys.begin());
  const ThingKey& a = keys[i - 1];
  const ThingKey& b = keys[i];
  if (equal(a.world_from_thing, b.world_from_thing)) return a.world_from_thing;
  const double s = (time - a.time) / (b.time - a.time);
  return cubic(a, velocity_at(keys, i - 1), b, velocity_at(keys, i), s);
}

std::function<Pose(const std::string&, double)> poses_of(std::vector<Thing> things) {
  return [things = std::move(things)](const std::string& name, double time) {
    const auto one = std::find_if(things.begin(), things.end(),
                                  [&name](const Thing& thing) { return thing.name == name; });
    return pose_at(*one, time);
  };
}

std::vector<Pose> poses_at(const World& world, double time) {
  std::vector<Pose> poses;
  poses.reserve(world.things.size());
  for (const Thing& thing : world.things) poses.push_back(pose_at(thing, time));
  return poses;
}

}  // namespace armsreach::sim
