// Postures with a name.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "devices/sim/hand/anatomy.hpp"
#include "devices/sim/hand/hand_pose.hpp"

namespace armsreach::sim {

// Those of the wearable vocabulary, a pinch, and the numerals of American Sign Language.
enum class Gesture {
  point,
  L,
  open,
  fist,
  grasp,
  pinch,
  zero,
  one,
  two,
  three,
  four,
  five,
  six,
  seven,
  eight,
  nine
};
inline constexpr int kGestureCount = 16;
std::string_view name(Gesture gesture);  // numerals are "0" to "9"
std::optional<Gesture> gesture_named(std::string_view name);

// How this person makes it: fingers that should touch do so, whatever their lengths.
// `manner` numbers the ways of making it that differ by some degrees in every joint; 0 is the
// usual.
HandPose pose_of(Gesture gesture, const HandAnatomy& anatomy, std::uint64_t manner = 0);

// How far the hand is turned about y when it is shown to somebody whom the palm faces otherwise, in
// radians: a zero is shown from the little finger's side.
double shown_turn(Gesture gesture);

}  // namespace armsreach::sim
