#include "vision/gesture/hand_identity.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::gesture {
namespace {

constexpr double kFarthest = 1.5;       // sizes that a hand may be from where it was expected
constexpr double kLongestGuess = 0.15;  // s for which a hand is expected to go on as it moved

}  // namespace

double HandIdentity::distance(const Known& known, const HandObservation& hand, Timestamp time) {
  const double guessed = std::min(seconds_from_timestamp(time - known.time), kLongestGuess);
  const double size = std::max(known.size, std::sqrt(hand.area));
  return (known.center + guessed * known.velocity - hand.center).norm() / std::max(size, 1.0);
}

void HandIdentity::remember(Known* known, const HandObservation& hand, Timestamp time) {
  const double seconds = seconds_from_timestamp(time - known->time);
  if (seconds > 0) known->velocity = (hand.center - known->center) / seconds;
  known->time = time;
  known->center = hand.center;
  known->size = std::sqrt(hand.area);
}

int HandIdentity::smallest_free() const {
  int id = 0;
  for (const Known& known : known_) {
    if (known.id == id) ++id;
  }
  return id;
}

std::vector<int> HandIdentity::assign(const HandObservations& hands, Timestamp time) {
  std::erase_if(known_, [time](const Known& known) {
    return seconds_from_timestamp(time - known.time) > kRemembered;
  });
  // The nearest pair first: with a few hands nothing cleverer finds a better matching.
  std::vector<int> ids(hands.size(), -1);
  std::vector<bool> taken(known_.size(), false);
  for (;;) {
    double nearest = kFarthest;
    std::size_t which = known_.size();
    std::size_t hand = 0;
    for (std::size_t k = 0; k < known_.size(); ++k) {
      for (std::size_t h = 0; h < hands.size(); ++h) {
        if (taken[k] || ids[h] >= 0) continue;
        const double apart = distance(known_[k], hands[h], time);
        if (apart >= nearest) continue;
        nearest = apart;
        which = k;
        hand = h;
      }
    }
    if (which == known_.size()) break;
    taken[which] = true;
    ids[hand] = known_[which].id;
    remember(&known_[which], hands[hand], time);
  }
  for (std::size_t h = 0; h < hands.size(); ++h) {
    if (ids[h] >= 0) continue;
    ids[h] = smallest_free();
    const auto after = std::find_if(known_.begin(), known_.end(),
                                    [&](const Known& known) { return known.id > ids[h]; });
    known_.insert(
        after, {ids[h], time, hands[h].center, Eigen::Vector2d::Zero(), std::sqrt(hands[h].area)});
  }
  return ids;
}

std::vector<int> HandIdentity::known() const {
  std::vector<int> ids;
  for (const Known& known : known_) ids.push_back(known.id);
  return ids;
}

}  // namespace armsreach::gesture
