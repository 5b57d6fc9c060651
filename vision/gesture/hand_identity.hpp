// Which hand of this image is which hand of the images before.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vision/core/time.hpp"
#include "vision/gesture/hand_observation.hpp"

namespace armsreach::gesture {

class HandIdentity {
 public:
  // A number for each hand, the smallest that is free: a single hand is always 0. A hand keeps its
  // number while it is out of sight for up to `kRemembered` seconds.
  std::vector<int> assign(const HandObservations& hands, Timestamp time);

  // Numbers in use, of hands seen or remembered, in order.
  std::vector<int> known() const;

  static constexpr double kRemembered = 0.5;

 private:
  struct Known {
    int id;
    Timestamp time;
    Eigen::Vector2d center;    // px
    Eigen::Vector2d velocity;  // px/s
    double size;               // px, the square root of the hand's area
  };
  // How unlikely it is that `known` has become `hand`: their distance in sizes of the hand.
  static double distance(const Known& known, const HandObservation& hand, Timestamp time);
  void remember(Known* known, const HandObservation& hand, Timestamp time);
  int smallest_free() const;

  std::vector<Known> known_;  // in order of id
};

}  // namespace armsreach::gesture
