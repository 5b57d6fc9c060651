#include "devices/sim/hand_truth.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace armsreach::sim {
namespace {

std::string free_name(const std::string& wished, const Truth& truth) {
  const auto taken = [&truth](const std::string& name) {
    return std::any_of(truth.hands.begin(), truth.hands.end(),
                       [&name](const TrueHand& hand) { return hand.name == name; });
  };
  std::string name = wished;
  for (int i = 2; taken(name); ++i) name = wished + " " + std::to_string(i);
  return name;
}

}  // namespace

int last_mask(const Truth& truth) {
  int last = 0;
  for (const TrueThing& thing : truth.things) last = std::max(last, thing.mask);
  for (const TrueHand& hand : truth.hands) last = std::max(last, hand.mask);
  return last;
}

void add_hands(const std::vector<HandTruth>& hands, Truth& truth) {
  int mask = last_mask(truth);
  for (const HandTruth& hand : hands) {
    TrueHand one;
    one.name = free_name(hand.left ? "left hand" : "right hand", truth);
    one.mask = ++mask;
    if (hand.gesture) one.gesture = name(*hand.gesture);
    one.holds = hand.holds;
    one.world_from_joint = hand.world_from_joint;
    truth.hands.push_back(std::move(one));
  }
}

}  // namespace armsreach::sim
