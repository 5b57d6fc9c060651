#include "devices/sim/holding.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace armsreach::sim {

Holding::Holding(const World& world, const std::vector<HandActor>& actors,
                 std::function<Pose(double)> world_from_camera)
    : actors_(actors), world_from_camera_(std::move(world_from_camera)) {
  for (std::size_t thing = 0; thing < world.things.size(); ++thing) {
    if (!world.things[thing].keys.empty()) continue;  // hands follow it instead
    Carried carried{thing, world.things[thing].world_from_thing, {}};
    for (std::size_t hand = 0; hand < actors_.size(); ++hand) {
      const std::vector<HandKey>& keys = actors_[hand].description().keys;
      for (std::size_t i = 0; i < keys.size(); ++i) {
        if (keys[i].hold != world.things[thing].name) continue;
        const bool again = i > 0 && keys[i - 1].hold == keys[i].hold;
        const double to =
            i + 1 < keys.size() ? keys[i + 1].time : std::numeric_limits<double>::infinity();
        if (again)
          carried.carries.back().to = to;
        else
          carried.carries.push_back({hand, keys[i].time, to, {}});
      }
    }
    if (carried.carries.empty()) continue;
    std::stable_sort(carried.carries.begin(), carried.carries.end(),
                     [](const Carry& a, const Carry& b) { return a.from < b.from; });
    carried_.push_back(carried);
    // How it lies in the hand follows from where the carries before have brought it.
    for (std::size_t i = 0; i < carried.carries.size(); ++i) {
      Carried before = carried_.back();
      before.carries.resize(i);
      Carry& carry = carried_.back().carries[i];
      carry.hand_from_thing =
          world_from_hand(carry.hand, carry.from).inverse() * pose_at(before, carry.from);
    }
  }
}

Pose Holding::world_from_hand(std::size_t hand, double time) const {
  return actors_[hand].world_from_hand(time, world_from_camera_(time));
}

Pose Holding::pose_at(const Carried& carried, double time) const {
  const auto after = std::upper_bound(carried.carries.begin(), carried.carries.end(), time,
                                      [](double t, const Carry& carry) { return t < carry.from; });
  if (after == carried.carries.begin()) return carried.first;
  const Carry& last = *std::prev(after);
  return world_from_hand(last.hand, std::min(time, last.to)) * last.hand_from_thing;
}

std::vector<PlacedThing> Holding::at(double time) const {
  std::vector<PlacedThing> placed;
  for (const Carried& carried : carried_) placed.push_back({carried.thing, pose_at(carried, time)});
  return placed;
}

}  // namespace armsreach::sim
