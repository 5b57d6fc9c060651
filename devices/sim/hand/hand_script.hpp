// What simulated hands do, as plain data: postures and places at key times.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/hand/gesture.hpp"
#include "devices/sim/hand/skin_tone.hpp"

namespace armsreach::sim {

// Where a script's places are: before the camera, wherever it goes, or in the world.
enum class HandFrame { camera, world };

// In the camera's frame a hand that is not turned shows its palm, fingers up. In the world's its
// fingers point along y and its palm faces up.
struct HandKey {
  double time = 0;  // s
  Gesture gesture = Gesture::open;
  double grip = 0;                // m: above 0, a grasp closed around a handle of this diameter
  Eigen::Vector3d at{0, 0, 0};    // the middle of the palm, m
  Eigen::Vector3d turn{0, 0, 0};  // rad about the frame's x, then y, then z
  double wrist_flexion = 0;       // rad, towards the palm
  double wrist_deviation = 0;     // rad, towards the thumb
  std::string hold;               // the thing that it holds until the next key; empty: none
  // The thing in whose frame `at` and `turn` are, wherever it goes; empty: the script's frame.
  // Turns are as in the world's frame; of a grip they and `at` place the handle (hand/grip.hpp).
  std::string on;
};

struct HandDescription {
  bool left = false;
  std::uint64_t seed = 1;  // of the person
  SkinTone skin = SkinTone::medium;
  bool glove = false;  // a dark one; what it carries for an infra-red camera is in worn.hpp
  bool sleeve = false;
  Eigen::Vector3d sleeve_color{0.25, 0.32, 0.45};  // sRGB
  HandFrame frame = HandFrame::camera;
  // In the script's frame, m: whence the arm comes, with an elbow between. Where there is none, and
  // nobody wears the camera, the wrist is bent as the script says and the arm ends at the elbow.
  std::optional<Eigen::Vector3d> shoulder;
  double repeat = 0;          // s, after which the keys begin anew; 0: they do not
  std::vector<HandKey> keys;  // times strictly increasing; rests at the first before it, at the
                              // last after it
};

}  // namespace armsreach::sim
