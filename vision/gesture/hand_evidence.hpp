// Whether what looks like a gesture is one, and is told.
//
// The detector's paper tells a gesture where g exceeds 0.7. Cupboards reach 0.95, so how like a
// gesture it is counts together with how far the next gesture is behind, and with what the blob is
// among the image's skin: walls and furniture lie along the border and in many pieces.
#pragma once

namespace armsreach::gesture {

struct HandEvidence {
  double likeness = 0;  // of the best gesture, -1..1
  double margin = 0;    // by which it exceeds the next one's
  double contact = 0;   // of the blob's outline on the image's border, in roots of its area
  double clutter = 0;   // share of the image's skin outside the hands
};

// Log odds, up to a constant, that it is a hand making that gesture.
double log_odds(const HandEvidence& evidence);

}  // namespace armsreach::gesture
