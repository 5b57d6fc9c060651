// Outlines of hands in the Sign Language Digits dataset: folders 0..9 of PERSON_*.JPG, one hand
// before a plain bright background.
#pragma once

#include <string>
#include <vector>

#include "bank_example.hpp"
#include "vision/gesture/skin_segmenter.hpp"

namespace armsreach::tools {

// Of people whose number divides by this nothing is learnt, so that they stay unseen.
constexpr int kPeopleToOneKept = 5;

// As `skin` sees them, with the faults that it has.
std::vector<BankExample> photographed_numerals(const std::string& folder,
                                               gesture::SkinSegmenter& skin);

}  // namespace armsreach::tools
