// What a person did with mouse and keyboard since the last frame, free of any window library.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace armsreach::render {

enum class Key { escape, space, tab, enter, del, left, right, up, down, f1, f11, letter };

struct KeyPress {
  Key key = Key::letter;
  char letter = 0;  // lower case, when key == letter
};

struct InputState {
  Eigen::Vector2f mouse{-1, -1};  // px in the window
  std::array<bool, 3> down{};     // left, right, middle
  std::array<bool, 3> clicked{};  // pressed since the last frame
  float wheel = 0;                // notches
  std::vector<KeyPress> keys;
  std::string text;  // UTF-8 typed
};

}  // namespace armsreach::render
