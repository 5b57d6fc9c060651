// A model of hands' texture from examples: logistic regression, ridged, by Newton's method.
#pragma once

#include <vector>

#include "vision/core/result.hpp"
#include "vision/gesture/hand_texture.hpp"

namespace armsreach::gesture {

struct TextureExample {
  TextureFeatures features{};
  bool hand = false;
  double weight = 1;  // above 0
};

// Both kinds count alike, whatever their numbers, and so do left and right hands: every example is
// one in the mirror as well. Fails where there is none of one kind; `where`
// names the examples in errors.
Result<TextureModel> fitted_texture_model(std::vector<TextureExample> examples,
                                          const std::string& where);

}  // namespace armsreach::gesture
