// Whether what looks like a gesture is one, and is told.
//
// The detector's paper tells a gesture where g exceeds 0.7. Cupboards reach 0.95, so how like a
// gesture it is counts together with how far the next gesture is behind, and with what the blob is:
// walls and furniture lie along the border, and have neither knuckles nor creases.
#pragma once

namespace armsreach::gesture {

struct HandEvidence {
  double likeness = 0;  // of the best gesture, -1..1
  double margin = 0;    // by which it exceeds the next one's
  double contact = 0;   // of the blob's outline on the image's border, in roots of its area
  double solidity = 1;  // share of the hand, without its forearm, in its convex hull
  double share = 0.06;  // of the image that the hand covers
  bool plain = false;   // the gesture has no finger stretched: most blobs look like it
  bool parted = false;  // from a wall of its own colour
  double texture = 0;   // log odds of what is within its outline, of hand_texture.hpp
};

// Log odds, up to a constant, that it is a hand making that gesture.
double log_odds(const HandEvidence& evidence);

}  // namespace armsreach::gesture
