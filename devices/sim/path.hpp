// The camera's way through the world: a smooth curve through key points, held by a hand.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/world.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

// A curve through given points with continuous velocity and acceleration: cubic pieces, periodic
// when closed, else without acceleration at both ends.
class Spline {
 public:
  using Point = Eigen::Matrix<double, 7, 1>;

  // Times strictly increasing. A closed curve is at the first point again at times[0] + period.
  Spline(std::vector<double> times, std::vector<Point> points, bool closed, double period);
  Point at(double time) const;

 private:
  std::vector<double> times_;
  std::vector<Point> points_;
  std::vector<Point> accelerations_;
  bool closed_;
  double period_;
};

// The unrest of a hand or a body: on each axis a sum of sines that fit the duration, so that what
// is closed closes with its unrest.
class Unrest {
 public:
  Unrest(const Tremor& tremor, double duration, std::uint64_t seed);
  Vector6d at(double time) const;  // a tangent, as Pose::exp takes it

 private:
  struct Sine {
    double amplitude;
    double angular_rate;  // rad/s
    double phase;
  };
  std::array<std::vector<Sine>, 6> axes_;
};

// Upright, looking along `forward`, which is not vertical. Camera: x right, y down, z forward.
Eigen::Quaterniond looking_along(const Eigen::Vector3d& forward);

class CameraPath {
 public:
  CameraPath(const PathDescription& description, std::uint64_t seed);

  // An open path stays at its end, a closed one goes round.
  Pose world_from_camera(double time) const;
  double duration() const { return duration_; }

 private:
  double duration_;
  bool closed_;
  Spline spline_;  // eye, target, roll
  Unrest unrest_;
};

}  // namespace armsreach::sim
