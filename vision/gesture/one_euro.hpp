// The One Euro filter of a pointer: a low pass whose cut-off rises with speed, so that a hand at
// rest does not tremble and one that moves does not lag (Casiez, Roussel, Vogel, CHI 2012).
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vision/core/time.hpp"

namespace armsreach::gesture {

struct OneEuroOptions {
  bool enabled = true;      // false: points pass as they are
  double min_cutoff = 1.2;  // Hz, at rest
  double beta = 1.5;        // Hz for each unit of length a second
  double speed_cutoff = 2;  // Hz, of the speed's own low pass
};

class OneEuro {
 public:
  explicit OneEuro(const OneEuroOptions& options = {}) : options_(options) {}

  // `unit` [px] is what speed is measured in: with the size of the hand the filter is the same for
  // every resolution and distance. A time that does not advance gives the last answer.
  Eigen::Vector2d filter(const Eigen::Vector2d& point, double unit, Timestamp time);
  void reset() { last_.reset(); }

 private:
  struct Sample {
    Timestamp time;
    Eigen::Vector2d raw;
    Eigen::Vector2d filtered;
    Eigen::Vector2d speed;  // units a second
  };
  OneEuroOptions options_;
  std::optional<Sample> last_;
};

}  // namespace armsreach::gesture
