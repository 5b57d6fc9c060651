// The measures of one person's hand: bones and the flesh around them, in metres.
//
// The hand frame stands in the wrist of a right hand: x to the thumb's side, y along the fingers,
// z out of the palm. A left hand is the mirror image in x = 0 of a right one.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace armsreach::sim {

struct FingerAnatomy {
  Eigen::Vector3d base{0, 0, 0};     // where its metacarpal begins, in the hand frame
  Eigen::Vector3d knuckle{0, 0, 0};  // where it ends
  std::array<double, 3> lengths{};   // proximal, intermediate, distal to the fingertip's surface
  std::array<double, 4> radii{};     // at both ends of the proximal, the last joint, in the tip
};

struct ThumbAnatomy {
  Eigen::Vector3d base{0, 0, 0};    // carpometacarpal joint, in the hand frame
  std::array<double, 3> lengths{};  // metacarpal, proximal, distal to the tip's surface
  std::array<double, 4> radii{};    // at both ends of the metacarpal, the last joint, in the tip
};

struct HandAnatomy {
  ThumbAnatomy thumb;
  std::array<FingerAnatomy, 4> fingers;  // index to little
  double breadth = 1;                    // of palm and wrist, against the mean
  double flesh = 1;                      // thickness of pads and of the palm, against the mean
  double forearm_length = 0;             // from the wrist to the elbow's crease
  double forearm_radius = 0;             // at its thickest, half of the mean of breadth and depth

  // From the wrist to the middle finger's tip when it is straight.
  double length() const;
  double palm_breadth() const;  // across the knuckles, skin to skin
};

// Halfway between women and men: 187 mm long, 85 mm broad. Bones as in Buryanov, Kotiuk,
// "Proportions of hand segments", Int. J. Morphology 28(3), 2010; overall size and its spread as
// in Greiner, "Hand anthropometry of U.S. Army personnel", 1991.
HandAnatomy mean_anatomy();

// A person: woman or man, each measure spread about its mean, bounded at two and a half sigma.
HandAnatomy random_anatomy(std::uint64_t seed);

}  // namespace armsreach::sim
