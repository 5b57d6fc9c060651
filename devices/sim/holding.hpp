// Where things are that hands take up, carry and put down.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "devices/sim/hand/hand_actor.hpp"
#include "devices/sim/world.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

struct PlacedThing {
  std::size_t thing = 0;  // index into World::things
  Pose world_from_thing;
};

// A thing goes with the hand as it lies at the moment when a key begins to hold it, and stays where
// it is let go.
class Holding {
 public:
  // `world_from_camera`: of every time, for hands before the camera.
  Holding(const World& world, const std::vector<HandActor>& actors,
          std::function<Pose(double)> world_from_camera);

  // All things that are ever held.
  std::vector<PlacedThing> at(double time) const;

 private:
  struct Carry {
    std::size_t hand = 0;
    double from = 0;
    double to = 0;
    Pose hand_from_thing;
  };
  struct Carried {
    std::size_t thing = 0;
    Pose first;                  // world_from_thing before it is taken up
    std::vector<Carry> carries;  // by time
  };
  Pose pose_at(const Carried& carried, double time) const;
  Pose world_from_hand(std::size_t hand, double time) const;

  std::vector<HandActor> actors_;
  std::function<Pose(double)> world_from_camera_;
  std::vector<Carried> carried_;
};

}  // namespace armsreach::sim
