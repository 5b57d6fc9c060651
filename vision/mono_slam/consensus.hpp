// Which of several measurements agree on where the camera is.
//
// One-point RANSAC (Civera, Grasa, Davison, Montiel, JFR 2010), without the chance: given one
// measurement, the filter's joint covariance says where all others should be, so every measurement
// is a hypothesis and each is tried. What supports the best one, and then whatever fits all of that
// within its remaining uncertainty, is kept.
#pragma once

#include <vector>

#include "vision/mono_slam/filter.hpp"

namespace armsreach::mono_slam {

struct ConsensusOptions {
  double pixel_tolerance = 1.0;  // of what supports a hypothesis, px
  // Squared Mahalanobis distance. Narrow: the filter's noise allows for errors that persist, which
  // a wrong match may not claim.
  double gate = 3;
};

// Indices of those that agree, in order.
std::vector<int> consensus(const JointInnovation& innovation, double pixel_sigma,
                           const ConsensusOptions& options);

}  // namespace armsreach::mono_slam
