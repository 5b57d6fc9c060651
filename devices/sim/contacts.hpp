// Which things of a world touch each other.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "devices/sim/world.hpp"

namespace armsreach::sim {

// Things touch when a point of the one's surface is within this of the other or inside of it.
constexpr double kTouching = 0.0015;  // m

class ContactFinder {
 public:
  explicit ContactFinder(const World& world);

  // Pairs (smaller index first) of which at least one can move, in order: what stands on what for
  // good is no news, and its pairs would be most. Only what has moved since
  // the last call is looked at anew.
  std::vector<std::pair<int, int>> at(const std::vector<Pose>& world_from_thing);

 private:
  struct Body {
    std::vector<int> parts;
    std::vector<Eigen::Vector3d> points;  // of the surface, in the thing's frame
    Eigen::AlignedBox3d box;              // in the thing's frame
  };
  struct Pair {
    Pose b_from_a;
    bool touching = false;
  };
  bool touch(int a, int b, const Pose& b_from_a) const;
  bool reaches(const Body& points_of, int other, const Pose& other_from_body) const;

  World world_;
  std::vector<Body> bodies_;
  std::map<std::pair<int, int>, Pair> known_;
};

}  // namespace armsreach::sim
