// A person who wears cameras: stands, sways, walks, turns, bends and reaches, and looks about.
#pragma once

#include <cstdint>
#include <vector>

#include "devices/sim/path.hpp"
#include "devices/sim/world.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

class Wearer {
 public:
  Wearer(const WearerDescription& description, const PathDescription& path, std::uint64_t seed);

  // Mounts with a camera's axes: x right, y down, z forward.
  Pose world_from_head(double time) const;      // between the eyes, looking where they look
  Pose world_from_shoulder(double time) const;  // on the right one, ahead and down
  Eigen::Vector3d shoulder(bool left, double time) const;  // its joint, in the world

 private:
  struct Body {
    Pose world_from_chest;  // x ahead, y left, z up, with the hips' place as its origin
    Eigen::Vector3d look;
    Vector6d unrest;
  };
  Body body_at(double time) const;
  double walked(double time) const;

  double height_;
  double duration_;
  bool closed_;
  Spline spline_;  // stand, heading, look, reach
  Unrest unrest_;
  std::vector<double> walked_;  // m, at steps of time from the start
};

}  // namespace armsreach::sim
