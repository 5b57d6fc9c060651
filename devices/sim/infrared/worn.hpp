// What a hand wears to be seen in infra-red light: a bracelet of tape segments around the wrist, a
// glove with a square on its back and a marker on every finger.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/hand/hand_surface.hpp"
#include "devices/sim/infrared/tape.hpp"

namespace armsreach::sim {

// A stiff ring. Its frame: the origin in the middle of the ring, y along the forearm towards the
// hand, -z to the back of the hand. Segments follow each other from the thumb's side over the back
// of the hand; the clasp, where the spacing does not fit, is at the inside of the wrist.
struct BraceletDescription {
  double radius = 0.031;   // m, of the tape's surface
  double segment = 0.007;  // m, side of a segment
  double spacing = 0.021;  // m along the band, from middle to middle
  double behind = 0.022;   // m behind the wrist
  double width = 0.014;    // m, of the band under the tape

  int segments() const;
};

// The square's frame: the origin in its middle, y towards the fingers, z away from the back of the
// hand. A smaller square is cut out of the quarter between fingers and thumb.
struct GloveDescription {
  double cell = 0.006;    // m; the square is 7 cells wide, the hole 2, one cell from its edges
  double finger = 0.009;  // m: diameter of the round markers on the fingers, side of the thumb's
};
inline constexpr int kGloveCells = 7;
inline constexpr int kGloveInnerCells = 2;

// Dark things that carry the tape, as triangles in the hand's frame.
struct WornPart {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Worn {
  std::vector<TapePiece> tape;
  std::vector<WornPart> carriers;
};

Pose forearm_from_bracelet(const BraceletDescription& bracelet);
// The square lies on the highest of what is under it.
Pose hand_from_square(const GloveDescription& glove, const HandSurface& surface);

// On a right hand in a posture, in the hand's frame. Pieces are named "bracelet 0", ..., "square",
// "thumb", "index", ...
void wear(const BraceletDescription& bracelet, const HandSkeleton& skeleton, Worn& worn);
void wear(const GloveDescription& glove, const HandSurface& surface, const HandSkeleton& skeleton,
          Worn& worn);

}  // namespace armsreach::sim
