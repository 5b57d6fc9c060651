#include "vision/relocalisation/matching.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace armsreach::relocalisation {
namespace {

int code_distance(const Code& a, const Code& b) {
  return std::popcount(a[0] ^ b[0]) + std::popcount(a[1] ^ b[1]);
}

int squared_distance(const Descriptor& a, const Descriptor& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const int difference = int{a[i]} - int{b[i]};
    sum += difference * difference;
  }
  return sum;
}

// The features whose codes are nearest, nearest first; -1 where there are fewer.
constexpr int kShortlist = 5;
using Shortlist = std::array<int, kShortlist>;

Shortlist nearest_codes(const Code& code, const std::vector<Code>& known) {
  std::array<int, kShortlist> distances;
  distances.fill(std::numeric_limits<int>::max());
  Shortlist nearest;
  nearest.fill(-1);
  for (std::size_t i = 0; i < known.size(); ++i) {
    const int distance = code_distance(code, known[i]);
    if (distance >= distances.back()) continue;
    int at = kShortlist - 1;
    for (; at > 0 && distances[at - 1] > distance; --at) {
      distances[at] = distances[at - 1];
      nearest[at] = nearest[at - 1];
    }
    distances[at] = distance;
    nearest[at] = static_cast<int>(i);
  }
  return nearest;
}

// A corner may be found at several sizes and orientations, which do not compete with each other.
bool same_place(const Feature& a, const Feature& b) {
  constexpr float kApart = 0.01F;  // of the rays: 3 pixels or so
  return (a.ray - b.ray).squaredNorm() < kApart * kApart;
}

}  // namespace

std::vector<Match> match_features(const Features& query, const Features& known, double ratio,
                                  std::size_t most) {
  std::vector<Match> matches;
  for (std::size_t i = 0; i < std::min(query.size(), most); ++i) {
    std::array<std::pair<int, int>, kShortlist> ranked;  // squared distance, feature
    std::size_t count = 0;
    for (const int candidate : nearest_codes(query.codes[i], known.codes)) {
      if (candidate < 0) break;
      ranked[count++] = {squared_distance(query.descriptors[i], known.descriptors[candidate]),
                         candidate};
    }
    if (count == 0) continue;
    std::sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(count));
    const auto [distance, best] = ranked[0];
    std::size_t next = 1;
    while (next < count && same_place(known.places[best], known.places[ranked[next].second]))
      ++next;
    // Where only one place is alike there is nothing to confuse it with.
    if (next < count && distance >= ratio * ratio * ranked[next].first) continue;
    matches.push_back({static_cast<int>(i), best});
  }
  return matches;
}

std::vector<Match> match_expected(const Features& query, const Features& known,
                                  const std::vector<Eigen::Vector2d>& expected, double radius) {
  constexpr int kAlike = 240 * 240;  // squared distance; 0.6 of a descriptor's length
  std::vector<Match> matches;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Eigen::Vector2f ray = expected[i].cast<float>();
    int best = -1;
    int best_distance = kAlike;
    for (std::size_t j = 0; j < query.size(); ++j) {
      if (!((query.places[j].ray - ray).squaredNorm() < static_cast<float>(radius * radius)))
        continue;
      const int distance = squared_distance(query.descriptors[j], known.descriptors[i]);
      if (distance >= best_distance) continue;
      best_distance = distance;
      best = static_cast<int>(j);
    }
    if (best >= 0) matches.push_back({best, static_cast<int>(i)});
  }
  return matches;
}

}  // namespace armsreach::relocalisation
