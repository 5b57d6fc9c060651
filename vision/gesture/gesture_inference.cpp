#include "vision/gesture/gesture_inference.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::gesture {
namespace {

// s that a gesture must have been shown before a blob is taken for a hand: edges of furniture look
// like one for a few frames.
constexpr double kEstablishing = 0.2;
constexpr double kEstablished = 5;  // s without a gesture after which it is not taken for one

}  // namespace

Gestures GestureInference::update(const HandObservations& seen, Timestamp time) {
  Gestures out;
  const std::vector<int> ids = identity_.assign(seen, time);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto track = tracks_.find(ids[i]);
    Track& of =
        track != tracks_.end()
            ? track->second
            : tracks_
                  .emplace(ids[i], Track{ModalFilter(options_.window),
                                         GestureMachine(options_.table), OneEuro(options_.cursor)})
                  .first->second;
    out.hands.push_back(follow(ids[i], of, seen[i], time, &out.actions));
  }
  std::sort(out.hands.begin(), out.hands.end(),
            [](const Hand& a, const Hand& b) { return a.id < b.id; });

  const std::vector<int> known = identity_.known();
  std::erase_if(tracks_, [&](const auto& entry) {
    return !std::binary_search(known.begin(), known.end(), entry.first);
  });
  for (auto& [id, track] : tracks_) {
    if (std::count(ids.begin(), ids.end(), id)) continue;
    if (const auto action = track.machine.step(kGone, time))
      out.actions.push_back({id, *action, track.last_pixel});
  }
  return out;
}

Hand GestureInference::follow(int id, Track& track, const HandObservation& seen, Timestamp time,
                              std::vector<HandAction>* actions) {
  const ModalFilter::Mode& mode = track.filter.update(seen.gesture.value_or(""), seen.score, time);
  const auto action = track.machine.step(mode.name.empty() ? kNothing : mode.name, time);
  const GestureTable::State& state = track.machine.state();

  const bool established = establish(track, time);
  follow_cursor(track, seen, time);
  Hand hand{id, seen, mode.name, mode.score, established, state.name, track.cursor, {}};
  if (state.direction) hand.direction = seen.angle;
  track.last_pixel = hand.cursor.value_or(seen.center);
  if (action) actions->push_back({id, *action, track.last_pixel});
  return hand;
}

bool GestureInference::establish(Track& track, Timestamp time) {
  if (track.filter.mode().name.empty()) {
    track.gesturing_since.reset();
  } else {
    if (!track.gesturing_since) track.gesturing_since = time;
    if (seconds_from_timestamp(time - *track.gesturing_since) >= kEstablishing)
      track.established = time;
  }
  return track.established && seconds_from_timestamp(time - *track.established) < kEstablished;
}

// Only a hand that shows its index finger has its tip where the outline is farthest. A frame that
// tells something else leaves the cursor where it is; a hand that does has none.
void GestureInference::follow_cursor(Track& track, const HandObservation& seen,
                                     Timestamp time) const {
  if (!track.machine.state().cursor || !has_cursor(options_.table, track.filter.mode().name)) {
    track.filtered_cursor.reset();
    track.cursor.reset();
    return;
  }
  if (!seen.gesture || !has_cursor(options_.table, *seen.gesture)) return;
  const double size = std::max(std::sqrt(seen.area), 1.0);
  track.cursor = track.filtered_cursor.filter(seen.fingertip, size, time);
}

std::optional<Eigen::Vector2d> midpoint(const std::vector<Hand>& hands) {
  if (hands.empty()) return std::nullopt;
  const Eigen::Vector2d& first = hands.front().seen.center;
  return hands.size() == 1 ? first : Eigen::Vector2d(0.5 * (first + hands[1].seen.center));
}

}  // namespace armsreach::gesture
