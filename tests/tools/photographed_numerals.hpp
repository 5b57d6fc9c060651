// Outlines of hands in the Sign Language Digits dataset: folders 0..9 of PERSON_*.JPG, one hand
// before a plain bright background.
#pragma once

#include <string>
#include <vector>

#include "bank_example.hpp"

namespace armsreach::tools {

// Of people with an even number only, so that the others stay unseen.
std::vector<BankExample> photographed_numerals(const std::string& folder);

}  // namespace armsreach::tools
