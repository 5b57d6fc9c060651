// Simulated hands as truth has them.
#pragma once

#include <vector>

#include "devices/sim/hand/hand_actor.hpp"
#include "devices/truth.hpp"

namespace armsreach::sim {

// The largest value in the masks so far.
int last_mask(const Truth& truth);

// Adds hands whose masks follow the last one; where a name is taken, they are numbered.
void add_hands(const std::vector<HandTruth>& hands, Truth& truth);

}  // namespace armsreach::sim
