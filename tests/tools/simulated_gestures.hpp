// Outlines of simulated hands: people of different build, seen from about where a wearer or a
// partner sees them, cut off at different places of the arm.
#pragma once

#include <vector>

#include "bank_example.hpp"

namespace armsreach::tools {

// point, L, open, fist, grasp; each also in the manners that other vocabularies of signs have.
std::vector<BankExample> simulated_wearable(int people);
// 0..9
std::vector<BankExample> simulated_numerals(int people);

}  // namespace armsreach::tools
