// Which feature of one image looks like which of another.
#pragma once

#include <vector>

#include "vision/relocalisation/features.hpp"

namespace armsreach::relocalisation {

struct Match {
  int query;
  int known;
};

// The nearest of `known` for each of the first `most` features of `query`, where the next best
// place is farther by more than 1 / ratio (Lowe 2004). Descriptors are compared for the few pairs
// whose codes differ least: ten times faster than comparing all, and nearly the same matches.
std::vector<Match> match_features(const Features& query, const Features& known, double ratio,
                                  std::size_t most);

// The same where a pose is known: for each of `known`, expected on the given ray (NaN: not seen),
// the most alike feature of `query` within `radius` of it, if it is alike at all.
std::vector<Match> match_expected(const Features& query, const Features& known,
                                  const std::vector<Eigen::Vector2d>& expected, double radius);

}  // namespace armsreach::relocalisation
